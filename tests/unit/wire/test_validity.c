/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Tests idl/wire_validity.c: which file of an identity begins last and ends first, and how that is
 * told. What programs do with it is shown in tests/service/security/secured.sh. */
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "check.h"
#include "wire_validity.h"

enum { DAY = 86400, START = 1764014400 }; /* 2025-11-24, 20:00 by UTC */

static const char *const FILES[] = {"cert.pem", "identity_ca.pem", "permissions_ca.pem",
                                    "permissions.p7s"};

static char folder[] = "/tmp/percuss-validity-XXXXXX";
static EVP_PKEY *key;

static FILE *create_file(const char *name)
{
    char path[sizeof folder + 32];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "we");
    assert_non_null(file);
    return file;
}

static void write_certificate(const char *name, time_t begin, time_t end)
{
    X509 *certificate = X509_new();
    assert_non_null(certificate);
    ASN1_TIME_set(X509_getm_notBefore(certificate), begin);
    ASN1_TIME_set(X509_getm_notAfter(certificate), end);
    assert_int_equal(X509_set_pubkey(certificate, key), 1);
    assert_true(X509_sign(certificate, key, EVP_sha256()) > 0);
    FILE *file = create_file(name);
    assert_int_equal(PEM_write_X509(file, certificate), 1);
    fclose(file);
    X509_free(certificate);
}

static void write_permissions(const char *text)
{
    FILE *file = create_file("permissions.p7s");
    fputs(text, file);
    fclose(file);
}

/* Certificates of a year, and permissions without a date. */
static int make_folder(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++)
        write_certificate(FILES[i], START - DAY, START + 365 * (time_t)DAY);
    write_permissions("no grant");
    return 0;
}

static int begin(void **state)
{
    (void)state;
    key = EVP_EC_gen("P-256");
    return key && mkdtemp(folder) ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    char path[sizeof folder + 32];
    for (size_t i = 0; i < sizeof FILES / sizeof *FILES; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, FILES[i]);
        unlink(path);
    }
    EVP_PKEY_free(key);
    return rmdir(folder);
}

static struct wire_validity read_folder(void)
{
    struct wire_validity validity;
    assert_null(wire_validity_read(folder, &validity));
    return validity;
}

static void what_ends_first_and_begins_last_counts(void **state)
{
    (void)state;
    struct wire_validity validity = read_folder();
    assert_string_equal(validity.ends, "cert.pem");
    assert_int_equal(validity.begin, START - DAY);
    assert_int_equal(validity.end, START + 365 * DAY);
    write_certificate("identity_ca.pem", START - 2 * DAY, START + 3 * DAY);
    write_certificate("permissions_ca.pem", START, START + 5 * DAY);
    validity = read_folder();
    assert_string_equal(validity.ends, "identity_ca.pem");
    assert_int_equal(validity.end, START + 3 * DAY);
    assert_string_equal(validity.begins, "permissions_ca.pem");
    assert_int_equal(validity.begin, START);
}

static void permissions_count_too(void **state)
{
    (void)state;
    write_permissions("<not_before>2025-11-24T19:00:00</not_before>\r\n"
                      "<not_after>\n 2025-11-25T20:00:00Z</not_after>\r\n");
    struct wire_validity validity = read_folder();
    assert_string_equal(validity.ends, "permissions.p7s");
    assert_int_equal(validity.end, START + DAY);
    assert_int_equal(validity.begin, START - 3600);
}

/* Several grants, other time zones, none at all: what DDS makes of them is its own. */
static void what_is_not_one_grant_is_left_to_dds(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "",
        "<not_before>2025-11-24T19:00:00</not_before><not_after>2025-11-25T20:00:00</not_after>"
        "<not_before>2025-11-24T19:00:00</not_before><not_after>2026-11-25T20:00:00</not_after>",
        "<not_before>2025-11-24T19:00:00</not_before><not_after>2025-11-25T20:00:00+02:00</"
        "not_after>",
        "<not_before>yesterday</not_before><not_after>2025-11-25T20:00:00</not_after>",
        "<not_before>2025-11-24T19:00:00</not_before>",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        write_permissions(texts[i]);
        assert_string_equal(read_folder().ends, "cert.pem");
    }
}

static void what_is_no_certificate_is_named(void **state)
{
    (void)state;
    struct wire_validity validity;
    for (int i = 0; i < 3; i++) {
        make_folder(NULL);
        fclose(create_file(FILES[i]));
        assert_string_equal(wire_validity_read(folder, &validity), FILES[i]);
    }
}

static const struct wire_validity YEAR = {
    .begin = START, .begins = "permissions.p7s", .end = START + 365 * DAY, .ends = "cert.pem"};

static void whoever_is_late_or_early_is_told_by_how_much(void **state)
{
    (void)state;
    char words[128];
    static const struct {
        time_t then;
        const char *words; /* NULL: it holds */
    } cases[] = {
        {START, NULL},
        {START + 365 * DAY, NULL},
        {START - 1, "permissions.p7s: begins in less than a day, on 2025-11-24"},
        {START - 10 * DAY, "permissions.p7s: begins in 10 days, on 2025-11-24"},
        {START + 365 * DAY + 1, "cert.pem: ended less than a day ago, on 2026-11-24"},
        {START + 366 * DAY, "cert.pem: ended 1 day ago, on 2026-11-24"},
        {START + 665 * DAY, "cert.pem: ended 300 days ago, on 2026-11-24"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bool holds = wire_validity_holds(&YEAR, cases[i].then, words, sizeof words);
        assert_int_equal(holds, cases[i].words == NULL);
        if (!holds)
            assert_string_equal(words, cases[i].words);
    }
}

static void the_last_thirty_days_are_told(void **state)
{
    (void)state;
    char words[128];
    const time_t last = START + 365 * DAY;
    assert_false(wire_validity_ends_soon(&YEAR, last - 30 * DAY, words, sizeof words));
    assert_true(wire_validity_ends_soon(&YEAR, last - 30 * DAY + 1, words, sizeof words));
    assert_string_equal(words, "cert.pem: ends in 29 days, on 2026-11-24");
    assert_true(wire_validity_ends_soon(&YEAR, last, words, sizeof words));
    assert_string_equal(words, "cert.pem: ends in less than a day, on 2026-11-24");
    assert_false(wire_validity_ends_soon(&YEAR, last + 1, words, sizeof words));
}

/* Two seconds early: DDS may look at the clock a moment later than whoever asks. */
static void it_is_over_a_moment_before_its_end(void **state)
{
    (void)state;
    const time_t last = START + 365 * DAY;
    assert_false(wire_validity_is_over(&YEAR, last - 3));
    assert_true(wire_validity_is_over(&YEAR, last - 2));
    assert_true(wire_validity_is_over(&YEAR, last + DAY));
    assert_false(wire_validity_is_over(&(struct wire_validity){.begins = NULL}, last));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_ends_first_and_begins_last_counts, make_folder),
        cmocka_unit_test_setup(permissions_count_too, make_folder),
        cmocka_unit_test_setup(what_is_not_one_grant_is_left_to_dds, make_folder),
        cmocka_unit_test(what_is_no_certificate_is_named),
        cmocka_unit_test(whoever_is_late_or_early_is_told_by_how_much),
        cmocka_unit_test(the_last_thirty_days_are_told),
        cmocka_unit_test(it_is_over_a_moment_before_its_end),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
