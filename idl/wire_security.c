/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "wire_security.h"

#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "wire_permissions.h"
#include "wire_revoked.h"
#include "wire_validity.h"

/* Files of an identity, and the properties that name them (DDS Security 1.1, 9.3.1 and 9.4.1). */
static const struct {
    const char *file, *property;
    bool secret;
} files[] = {
    {"identity_ca.pem", "dds.sec.auth.identity_ca", false},
    {"cert.pem", "dds.sec.auth.identity_certificate", false},
    {"key.pem", "dds.sec.auth.private_key", true},
    {"permissions_ca.pem", "dds.sec.access.permissions_ca", false},
    {"governance.p7s", "dds.sec.access.governance", false},
    {"permissions.p7s", "dds.sec.access.permissions", false},
};

/* Plugins: Cyclone DDS's, and those of wire_permissions.h in the library that has them (NULL). */
static const struct {
    const char *property, *value;
} plugins[] = {
    {"dds.sec.auth.library.path", "dds_security_auth"},
    {"dds.sec.auth.library.init", "init_authentication"},
    {"dds.sec.auth.library.finalize", "finalize_authentication"},
    {"dds.sec.access.library.path", NULL},
    {"dds.sec.access.library.init", "percuss_plugin_access_init"},
    {"dds.sec.access.library.finalize", "percuss_plugin_access_end"},
    {"dds.sec.crypto.library.path", NULL},
    {"dds.sec.crypto.library.init", "percuss_plugin_crypto_init"},
    {"dds.sec.crypto.library.finalize", "percuss_plugin_crypto_end"},
};

enum { FILE_COUNT = sizeof files / sizeof *files, PLUGIN_COUNT = sizeof plugins / sizeof *plugins };

/* What is wrong with a file; NULL: nothing. */
static const char *find_fault(const char *path, bool secret)
{
    struct stat about;
    if (stat(path, &about) != 0 || access(path, R_OK) != 0)
        return strerror(errno);
    if (!S_ISREG(about.st_mode) || about.st_size == 0)
        return "must be a file that is not empty";
    if (secret && (about.st_mode & (S_IRWXG | S_IRWXO)))
        return "must be open to its owner alone (chmod 0600)";
    return NULL;
}

static FILE *open_file(const char *folder, const char *name)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return fopen(path, "rbe");
}

/* DDS would take another key, with which nobody would ever believe the certificate. */
static bool key_fits(const char *folder)
{
    FILE *certificate_file = open_file(folder, "cert.pem"),
         *key_file = open_file(folder, "key.pem");
    X509 *certificate = certificate_file ? PEM_read_X509(certificate_file, NULL, NULL, NULL) : NULL;
    /* the empty pass phrase, so that nobody is asked for one */
    EVP_PKEY *key = key_file ? PEM_read_PrivateKey(key_file, NULL, NULL, "") : NULL;
    bool good = certificate && key && X509_check_private_key(certificate, key) == 1;
    X509_free(certificate);
    EVP_PKEY_free(key);
    ERR_clear_error();
    if (certificate_file)
        fclose(certificate_file);
    if (key_file)
        fclose(key_file);
    return good;
}

/* Nobody believes what has ended, or has not begun. */
static bool dates_fit(const char *folder, char *problem, size_t size)
{
    struct wire_validity validity;
    char words[128];
    const char *none = wire_validity_read(folder, &validity);
    if (none) {
        snprintf(problem, size, "security: %s/%s: must be a certificate (PEM)", folder, none);
        return false;
    }
    if (wire_validity_holds(&validity, time(NULL), words, sizeof words))
        return true;
    snprintf(problem, size, "security: %s/%s", folder, words);
    return false;
}

/* The first certificate in a file of the folder; NULL: none. */
static X509 *read_certificate(const char *folder, const char *name)
{
    FILE *file = open_file(folder, name);
    X509 *certificate = file ? PEM_read_X509(file, NULL, NULL, NULL) : NULL;
    if (file)
        fclose(file);
    ERR_clear_error();
    return certificate;
}

/* The list of revoked certificates; NULL: there is no crl.pem, or with a problem. Its own dates do
 * not matter: who was revoked stays so. */
static X509_CRL *read_list(const char *folder, char *problem, size_t size)
{
    problem[0] = 0;
    FILE *file = open_file(folder, "crl.pem");
    if (!file && errno != ENOENT)
        snprintf(problem, size, "security: %s/crl.pem: %s", folder, strerror(errno));
    if (!file)
        return NULL;
    X509_CRL *list = PEM_read_X509_CRL(file, NULL, NULL, NULL);
    X509 *authority = read_certificate(folder, "identity_ca.pem");
    if (!list || !authority || X509_CRL_verify(list, X509_get0_pubkey(authority)) != 1)
        snprintf(problem, size,
                 "security: %s/crl.pem: must be a list of revoked certificates (PEM) that "
                 "identity_ca.pem has signed",
                 folder);
    X509_free(authority);
    ERR_clear_error();
    fclose(file);
    if (!problem[0])
        return list;
    X509_CRL_free(list);
    return NULL;
}

/* Nobody believes what is revoked. */
static bool list_fits(const char *folder, char *problem, size_t size)
{
    X509_CRL *list = read_list(folder, problem, size);
    X509 *own = read_certificate(folder, "cert.pem");
    X509_REVOKED *entry;
    if (list && own && X509_CRL_get0_by_cert(list, &entry, own) == 1)
        snprintf(problem, size, "security: %s/cert.pem: is revoked, by crl.pem", folder);
    X509_free(own);
    X509_CRL_free(list);
    return !problem[0];
}

bool wire_security_check(const char *folder, char *problem, size_t size)
{
    char path[PATH_MAX];
    /* threads of DDS use OpenSSL until the process has ended */
    OPENSSL_init_crypto(OPENSSL_INIT_NO_ATEXIT, NULL);
    for (size_t i = 0; i < FILE_COUNT; i++) {
        int length = snprintf(path, sizeof path, "%s/%s", folder, files[i].file);
        const char *fault = (size_t)length < sizeof path ? find_fault(path, files[i].secret)
                                                         : "has too long a name";
        if (fault) {
            snprintf(problem, size, "security: %s/%s: %s", folder, files[i].file, fault);
            return false;
        }
    }
    if (!key_fits(folder)) {
        snprintf(problem, size, "security: %s: key.pem must be the key of cert.pem", folder);
        return false;
    }
    return dates_fit(folder, problem, size) && list_fits(folder, problem, size);
}

bool wire_security_remark(const char *folder, const struct wire_validity *validity, time_t then,
                          char *remark, size_t size)
{
    char words[128];
    if (!wire_validity_holds(validity, then, words, sizeof words))
        snprintf(remark, size, "security: %s/%s", folder, words);
    else if (wire_validity_ends_soon(validity, then, words, sizeof words))
        snprintf(remark, size, "security: %s/%s: make the folder anew before", folder, words);
    else
        return false;
    return true;
}

bool wire_security_revoke(const char *folder, struct wire_revocation *found, char *problem,
                          size_t size)
{
    X509_CRL *list = read_list(folder, problem, size);
    if (problem[0])
        return false;
    *found = (struct wire_revocation){0};
    if (list && !wire_revoked_take(folder, list, &found->lost)) {
        snprintf(problem, size, "security: %s/crl.pem: out of memory", folder);
        return false;
    }
    found->listed = wire_revoked_count(folder);
    found->is_missing = !list && found->listed > 0;
    found->cut_off = wire_permissions_cut();
    return true;
}

unsigned long long wire_security_refused(void)
{
    return wire_permissions_refused();
}

/* Of idl/plugins/wire_plugins.c, in the programs and libraries that open secured participants. */
extern const char *const wire_plugin_library __attribute__((weak));

/* The name by which DDS loads this program or library as one of plugins; of a program that has no
 * plugins one that is not there, so that its participants are refused. */
static const char *find_plugins(void)
{
    Dl_info about;
    if (!&wire_plugin_library)
        return "percuss-plugins-that-this-program-lacks";
    if (*wire_plugin_library)
        return wire_plugin_library;
    return dladdr(&wire_plugin_library, &about) ? about.dli_fname : "";
}

bool wire_security_set(const char *folder, dds_qos_t *qos)
{
    char name[PATH_MAX + sizeof "file:"], problem[PATH_MAX + 128];
    struct wire_revocation revocation;
    if (!wire_security_revoke(folder, &revocation, problem, sizeof problem))
        return false;
    for (size_t i = 0; i < PLUGIN_COUNT; i++)
        dds_qset_prop(qos, plugins[i].property,
                      plugins[i].value ? plugins[i].value : find_plugins());
    for (size_t i = 0; i < FILE_COUNT; i++) {
        snprintf(name, sizeof name, "file:%s/%s", folder, files[i].file);
        dds_qset_prop(qos, files[i].property, name);
    }
    return true;
}
