/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Prints every key of the catalogue or of the settings, with what it may be, its default and its
 * meaning, from the tables that check them: as Markdown or in the language of man pages.
 * reference.sh puts it into the pages.
 * usage: print_reference catalogue|settings markdown|man */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "catalogue/keys.h"
#include "model/body_kind.h"
#include "respond/settings.h"

struct row {
    const char *name, *allowed;
    const char *otherwise; /* NULL: required */
    const char *meaning;
};

/* How a page is written. */
struct form {
    void (*begin)(const char *heading); /* NULL: none */
    void (*row)(const struct row *row);
    void (*end)(void);
};

static void markdown_text(const char *text)
{
    for (; *text; text++)
        printf(*text == '|' || *text == '<' || *text == '*' ? "\\%c" : "%c", *text);
}

static void markdown_begin(const char *heading)
{
    if (heading)
        printf("\n## %s\n", heading);
    printf("\n| key | what it must be | default | |\n|---|---|---|---|\n");
}

static void markdown_row(const struct row *row)
{
    printf("| `%s` | ", row->name);
    markdown_text(row->allowed);
    printf(" | ");
    markdown_text(row->otherwise ? row->otherwise : "required");
    printf(" | ");
    markdown_text(row->meaning);
    puts(" |");
}

static void markdown_end(void)
{
}

static void man_text(const char *text)
{
    for (; *text; text++)
        printf(*text == '\\' ? "\\e" : *text == '-' ? "\\-" : "%c", *text);
}

static void man_begin(const char *heading)
{
    if (heading)
        printf(".Ss %s\n", heading);
    puts(".Bl -tag -width Ds");
}

static void man_row(const struct row *row)
{
    /* in sentences, none of which begins with a point, which would be a command */
    printf(".It Cm %s\n%c", row->name, toupper((unsigned char)row->meaning[0]));
    man_text(row->meaning + 1);
    printf(".\nIt must be ");
    man_text(row->allowed);
    printf(row->otherwise ? ".\nDefault: " : ".\nRequired");
    man_text(row->otherwise ? row->otherwise : "");
    puts(".");
}

static void man_end(void)
{
    puts(".El");
}

/* With the keys of sections, under their whole names. */
static void print_table(const struct form *form, const struct key_table *table, const char *before)
{
    const struct key *key;
    for (size_t i = 0; (key = key_at(table, i)); i++) {
        char name[80];
        struct key_text allowed = key_allowed(key);
        snprintf(name, sizeof name, "%s%s", before, key->name);
        form->row(&(struct row){name, allowed.text, key->otherwise, key->meaning});
        if (key->nested && table != &keys_top) {
            snprintf(name, sizeof name, "%s%s.", before, key->name);
            print_table(form, key->nested, name);
        }
    }
}

static void print_section(const struct form *form, const char *heading,
                          const struct key_table *table)
{
    form->begin(heading);
    print_table(form, table, "");
    form->end();
}

/* What it has besides shape and material; its material where that need not be there. */
static void print_kind(const struct form *form, const struct body_kind *kind)
{
    char heading[80];
    const struct key_table own = {kind->name, kind->keys, kind->key_count, NULL};
    const struct key_table material = {kind->name, &keys_own.keys[1], 1, NULL};
    if (kind->key_count == 0)
        return;
    snprintf(heading, sizeof heading, "Shape %s", kind->name);
    form->begin(heading);
    print_table(form, &own, "");
    if (kind->own_material)
        print_table(form, &material, "");
    form->end();
}

static void print_catalogue(const struct form *form)
{
    print_section(form, "The whole file", &keys_top);
    print_section(form, "A material", &keys_material);
    print_section(form, "A term of a relaxation", &keys_relaxation);
    print_section(form, "Contact", &keys_contact);
    print_section(form, "Friction between two materials", &keys_friction);
    print_section(form, "A law of contacts", &keys_law);
    print_section(form, "Every body", &keys_body);
    const struct body_kind *kind;
    for (size_t i = 0; (kind = body_kind_at(i)); i++)
        print_kind(form, kind);
    print_section(form, "A site of a mesh", &keys_site);
}

static void print_settings(const struct form *form)
{
    struct settings_row row;
    form->begin(NULL);
    for (size_t i = 0; settings_describe(i, &row); i++)
        form->row(&(struct row){row.path, row.allowed, row.otherwise, row.meaning});
    form->end();
}

int main(int argc, char **argv)
{
    static const struct form markdown = {markdown_begin, markdown_row, markdown_end};
    static const struct form man = {man_begin, man_row, man_end};
    if (argc != 3)
        return 2;
    const struct form *form = strcmp(argv[2], "man") == 0 ? &man : &markdown;
    if (strcmp(argv[1], "catalogue") == 0)
        print_catalogue(form);
    else
        print_settings(form);
    return EXIT_SUCCESS;
}
