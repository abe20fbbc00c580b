/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "complete_line.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { OFFER_SIZE = 512 };

bool line_options_end(const struct argp_option *option)
{
    return !option->name && !option->key && !option->doc && !option->group;
}

const struct argp *line_argp(const struct line *line)
{
    return line->command ? line->command->argp : &common_argp;
}

void line_offer(const struct line *line, const char *text, const char *what)
{
    char whole[OFFER_SIZE];
    if (strncmp(text, line->word, strlen(line->word)) != 0)
        return;
    snprintf(whole, sizeof whole, "%.*s%s", line->before_length, line->before, text);
    printf("%s\t%s\n", whole + (line->split < strlen(whole) ? line->split : 0), what ? what : "");
}

const struct argp_option *line_find_option(const struct argp *argp, const char *name, size_t length,
                                           int letter)
{
    const struct argp_option *found = NULL;
    for (const struct argp_option *o = argp->options; o && !line_options_end(o) && !found; o++) {
        bool named = o->name && strlen(o->name) == length && !strncmp(o->name, name, length);
        if (letter ? o->key == letter : named)
            found = o;
    }
    for (const struct argp_child *child = argp->children; child && child->argp && !found; child++)
        found = line_find_option(child->argp, name, length, letter);
    return found;
}

/* A server's id, or how it is chosen; anything else is no server's. */
static void take_server(struct common *common, const char *value)
{
    size_t length = strlen(value);
    bool good = strspn(value, "0123456789abcdef") == length || !strcmp(value, PERCUSS_LEAST_LOADED);
    if (good && length < sizeof common->server)
        memcpy(common->server, value, length + 1);
}

/* Takes the value of an option that chooses the server or the bodies. */
static void take_value(struct line *line, char *value)
{
    char *end;
    const char *name = line->option->name;
    struct common *common = line->common;
    unsigned long number = strtoul(value, &end, 10);
    if (!strcmp(name, "partition"))
        common->partition = value;
    else if (!strcmp(name, "security"))
        common->security = value;
    else if (!strcmp(name, "catalogue"))
        common->catalogue = value;
    else if (!strcmp(name, "config"))
        common->config = value;
    else if (!strcmp(name, "domain") && *value && !*end)
        common->domain = (uint32_t)number;
    else if (!strcmp(name, "server"))
        take_server(common, value);
    else if (!strcmp(name, "a") || !strcmp(name, "b"))
        line->bodies[*name - 'a'] = value;
    line->option = NULL;
}

/* The option that a word begins with, and its value in *value if that is in the word, too. */
static const struct argp_option *take_option(struct line *line, char *word, char **value)
{
    const struct argp *argp = line_argp(line);
    const struct argp_option *option;
    if (word[1] == '-') {
        char *equals = strchr(word, '=');
        size_t length = equals ? (size_t)(equals - word) : strlen(word);
        option = line_find_option(argp, word + 2, length - 2, 0);
        *value = equals ? equals + 1 : NULL;
    } else {
        option = line_find_option(argp, NULL, 0, word[1]);
        *value = word[1] && word[2] ? word + 2 : NULL;
    }
    return option;
}

/* One whole word. */
static void take_word(struct line *line, char *word)
{
    char *value;
    if (line->option && !(line->option->flags & OPTION_ARG_OPTIONAL)) {
        take_value(line, word);
    } else if (word[0] == '-' && word[1]) {
        line->option = take_option(line, word, &value);
        if (line->option && line->option->key == OPTION_LOCAL)
            line->common->local = true;
        if (line->option && !line->option->arg)
            line->option = NULL;
        if (value && line->option)
            take_value(line, value);
    } else if (!line->command && !line->help) {
        line->help = !strcmp(word, "help");
        line->command = commands_find(word);
    }
}

/* The unfinished word: the value may have begun in it. */
static void take_last(struct line *line, char *word)
{
    char *value = NULL;
    line->word = line->before = word;
    if (line->option && !(line->option->flags & OPTION_ARG_OPTIONAL))
        return;
    line->option = word[0] == '-' ? take_option(line, word, &value) : NULL;
    if (!value || !line->option) {
        line->option = NULL;
        return;
    }
    line->word = value;
    line->before_length = (int)(value - word);
}

/* Where bash splits words, too. */
static bool is_separator(const char *word)
{
    return !strcmp(word, "=") || !strcmp(word, ":") || !strcmp(word, "@");
}

bool line_read(int count, char **words, struct common *common, struct line *line)
{
    size_t size = 1;
    for (int i = 0; i < count; i++)
        size += strlen(words[i]) + 1;
    *line = (struct line){.common = common, .text = calloc(1, size)};
    char *word = line->text, *end = word;
    /* words that a shell has split are joined again */
    for (int i = 0; i < count; i++) {
        bool split = i > 0 && (is_separator(words[i]) ||
                               (is_separator(words[i - 1]) && strncmp(words[i], "--", 2) != 0));
        if (i > 0 && !split && word) {
            take_word(line, word);
            word = ++end;
        }
        if (!word)
            return false;
        /* it completes the rest behind the last place where it does so */
        line->split = split ? (size_t)(end - word) + (is_separator(words[i]) ? 1 : 0) : 0;
        end = stpcpy(end, words[i]);
    }
    if (word)
        take_last(line, word);
    return word;
}

void line_free(struct line *line)
{
    free(line->text);
}
