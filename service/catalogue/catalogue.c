/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "catalogue/catalogue.h"

#include <errno.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "catalogue/content.h"
#include "catalogue/guard.h"
#include "catalogue/reader.h"
#include "catalogue/revision.h"

static enum percuss_status out_of_memory(const char *name, struct fault *fault)
{
    return fault_set(fault, PERCUSS_INTERNAL, "%s: out of memory", reader_short_name(name));
}

/* The guard has parsed the same text before: only memory can fail here. */
static enum percuss_status load_document(const char *text, size_t size, const char *name,
                                         yaml_document_t *document, struct fault *fault)
{
    yaml_parser_t parser;
    if (!yaml_parser_initialize(&parser))
        return out_of_memory(name, fault);
    yaml_parser_set_encoding(&parser, YAML_UTF8_ENCODING);
    yaml_parser_set_input_string(&parser, (const unsigned char *)text, size);
    int loaded = yaml_parser_load(&parser, document);
    yaml_parser_delete(&parser);
    return loaded ? PERCUSS_OK : out_of_memory(name, fault);
}

/* What is made of a document. */
struct product {
    struct body_set *set;
    const char *folder; /* of reduced bodies; NULL: none */
    bool lenient;       /* with bodies whose files lack */
    const char *name;   /* of the material wanted; NULL: the whole set is */
    struct material *material;
};

static enum percuss_status read_product(struct reader *reader, const struct product *product)
{
    if (product->name)
        return content_read_material(reader, product->name, product->material);
    enum percuss_status status = content_read(reader, product->set);
    return status ? status : revision_write(product->set, reader->fault);
}

static enum percuss_status parse(const char *text, size_t size, const char *name,
                                 const struct product *product, struct fault *fault)
{
    yaml_document_t document;
    enum percuss_status status = guard_check(text, size, name, fault);
    if (!status)
        status = load_document(text, size, name, &document, fault);
    if (status)
        return status;
    struct reader reader = {.document = &document,
                            .name = name,
                            .folder = product->folder,
                            .lenient = product->lenient,
                            .fault = fault};
    status = read_product(&reader, product);
    yaml_document_delete(&document);
    return status;
}

/* Numbers have a point in every country, in the file and in messages. */
static enum percuss_status parse_plainly(const char *text, size_t size, const char *name,
                                         const struct product *product, struct fault *fault)
{
    if (size > CATALOGUE_MAX_BYTES)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: too long: must be at most %d bytes",
                         reader_short_name(name), CATALOGUE_MAX_BYTES);
    locale_t plain = newlocale(LC_NUMERIC_MASK, "C", (locale_t)0);
    if (!plain)
        return out_of_memory(name, fault);
    locale_t caller = uselocale(plain);
    enum percuss_status status = parse(text ? text : "", text ? size : 0, name, product, fault);
    uselocale(caller);
    freelocale(plain);
    return status;
}

static enum percuss_status parse_set(const char *text, size_t size, const char *name,
                                     struct product product, struct body_set **set,
                                     struct fault *fault)
{
    /* the caller gets a whole set or none */
    struct body_set *fresh = calloc(1, sizeof *fresh);
    *set = NULL;
    if (!fresh)
        return out_of_memory(name, fault);
    product.set = fresh;
    enum percuss_status status = parse_plainly(text, size, name, &product, fault);
    if (status)
        body_set_free(fresh);
    else
        *set = fresh;
    return status;
}

enum percuss_status catalogue_parse(const char *text, size_t size, const char *name,
                                    struct body_set **set, struct fault *fault)
{
    return parse_set(text, size, name, (struct product){.set = NULL}, set, fault);
}

static enum percuss_status unreadable(const char *path, struct fault *fault)
{
    return fault_set(fault, PERCUSS_BAD_REQUEST, "%s: cannot be read: %s", reader_short_name(path),
                     strerror(errno));
}

/* The text of a file, for free(). */
static enum percuss_status read_file(const char *path, char **text, size_t *size,
                                     struct fault *fault)
{
    enum percuss_status status = PERCUSS_OK;
    size_t got;
    *size = 0;
    FILE *file = fopen(path, "rbe");
    if (!file)
        return unreadable(path, fault);
    /* one byte more than allowed tells a file that is too long */
    *text = malloc(CATALOGUE_MAX_BYTES + 1);
    if (!*text) {
        status = out_of_memory(path, fault);
        goto close;
    }
    while ((got = fread(*text + *size, 1, CATALOGUE_MAX_BYTES + 1 - *size, file)) > 0)
        *size += got;
    if (ferror(file)) {
        status = unreadable(path, fault);
        free(*text);
    }
close:
    fclose(file);
    return status;
}

static enum percuss_status load(const char *path, struct product product, struct body_set **set,
                                struct fault *fault)
{
    char *text;
    size_t size;
    *set = NULL;
    enum percuss_status status = read_file(path, &text, &size, fault);
    if (status)
        return status;
    status = parse_set(text, size, path, product, set, fault);
    free(text);
    return status;
}

enum percuss_status catalogue_load(const char *path, struct body_set **set, struct fault *fault)
{
    return load(path, (struct product){.set = NULL}, set, fault);
}

enum percuss_status catalogue_load_reducing(const char *path, const char *folder,
                                            struct body_set **set, struct fault *fault)
{
    return load(path, (struct product){.folder = folder, .lenient = true}, set, fault);
}

enum percuss_status catalogue_material(const char *path, const char *name,
                                       struct material *material, struct fault *fault)
{
    char *text;
    size_t size;
    const struct product product = {.name = name, .material = material};
    enum percuss_status status = read_file(path, &text, &size, fault);
    if (status)
        return status;
    status = parse_plainly(text, size, path, &product, fault);
    free(text);
    return status;
}
