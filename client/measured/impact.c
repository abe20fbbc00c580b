/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "impact.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "divide.h"
#include "fall.h"
#include "table.h"
#include "text.h"

/* Where the columns that are numbers go. */
static const size_t OFFSETS[IMPACT_HISTORY] = {
    [IMPACT_SPEED] = offsetof(struct measured_impact, speed),
    [IMPACT_RESTITUTION] = offsetof(struct measured_impact, restitution),
    [IMPACT_IMPULSE] = offsetof(struct measured_impact, impulse),
    [IMPACT_SUB_IMPACTS] = offsetof(struct measured_impact, sub_impacts),
    [IMPACT_FIRST_IMPULSE] = offsetof(struct measured_impact, first_impulse),
    [IMPACT_FIRST_DURATION] = offsetof(struct measured_impact, first_duration),
    [IMPACT_SECOND_START] = offsetof(struct measured_impact, second_start),
    [IMPACT_AT] = offsetof(struct measured_impact, at),
    [IMPACT_V_OUT] = offsetof(struct measured_impact, v_out),
    [IMPACT_DROP] = offsetof(struct measured_impact, drop),
    [IMPACT_REBOUND] = offsetof(struct measured_impact, rebound),
    [IMPACT_BOUNCE] = offsetof(struct measured_impact, bounce),
};

/* The numbers that a row may lack. */
enum { LACKS_SPEED, LACKS_OUTCOME, LACKS };
static const char *const REASONS[LACKS] = {"no speed", "no restitution, v_out, impulse or history"};

struct measured_impact measured_impact_unknown(void)
{
    struct measured_impact impact;
    double *numbers = (double *)&impact;
    for (size_t i = 0; i < sizeof impact / sizeof(double); i++)
        numbers[i] = NAN;
    return impact;
}

struct measured_impact measured_impact_from(const struct history_impacts *history, size_t *next)
{
    struct measured_impact impact = measured_impact_unknown();
    const struct history_sub_impact *list = &history->list[*next];
    size_t count = 1;
    while (*next + count < history->count && !list[count].begins)
        count++;
    *next += count;
    impact.speed = list[0].approach < 0.0 ? -list[0].approach : NAN;
    impact.doubt = list[0].doubt;
    if (history->of_b)
        impact.momentum_of_b = 1.0;
    impact.sub_impacts = (double)count;
    impact.momentum = 0.0;
    for (size_t k = 0; k < count; k++)
        impact.momentum += list[k].jump;
    impact.first_momentum = list[0].jump;
    impact.first_duration = list[0].end - list[0].start;
    for (size_t k = 1; k < count && isnan(impact.second_start); k++)
        if (list[k].jump >= 0.01 * impact.momentum)
            impact.second_start = list[k].start - list[0].start;
    return impact;
}

void measured_set_free(struct measured_set *set)
{
    free(set->impacts);
    free(set->left);
    *set = (struct measured_set){0};
}

bool measured_append(struct measured_set *set, const struct measured_impact *impact)
{
    if (set->count == set->room) {
        size_t room = set->room ? 2 * set->room : 64;
        struct measured_impact *impacts = realloc(set->impacts, room * sizeof *impacts);
        if (!impacts)
            return false;
        set->impacts = impacts;
        set->room = room;
    }
    set->impacts[set->count++] = *impact;
    return true;
}

/* The file beside the table's. */
static bool path_beside(const char *table, const char *name, char *path, size_t size)
{
    const char *slash = strrchr(table, '/');
    int folder = slash && *name != '/' ? (int)(slash - table) + 1 : 0;
    return (size_t)snprintf(path, size, "%.*s%s", folder, table, name) < size;
}

/* The sub-impacts of the history that a row names. */
static bool find_history(const char *file, const char *name, const struct column_map *map,
                         struct history_impacts *found, struct measured_remarks *remarks)
{
    char path[1024];
    struct history history;
    struct measured_fault reason;
    /* beside the file that names it */
    if (!path_beside(file, name, path, sizeof path))
        return remarks_wrong(remarks, "%s: history '%s': the path is too long", text_name(file),
                             name);
    if (!text_is_file(path, &reason))
        return remarks_wrong(remarks, "%s", reason.text);
    if (!history_read(path, map, &history, remarks))
        return false;
    bool good = history_find(&history, found, &reason);
    history_free(&history);
    return good || remarks_wrong(remarks, "%s: %.400s", path, reason.text);
}

/* Fills the unknown numbers of a row by its history. */
static void fill_unknown(const struct measured_impact *told, struct measured_impact *impact)
{
    double *to = (double *)impact;
    const double *from = (const double *)told;
    for (size_t i = 0; i < sizeof *told / sizeof(double); i++)
        if (isnan(to[i]))
            to[i] = from[i];
}

/* Where the row states the speed and the history the rest, the interval is of both. */
static void add_doubt(const struct measured_impact *stated, struct measured_impact *told)
{
    const bool outcome =
        !isnan(stated->restitution) || !isnan(stated->impulse) || !isnan(stated->momentum);
    if (outcome)
        told->doubt = stated->doubt;
    else if (!isnan(stated->doubt))
        told->doubt = hypot(told->doubt, stated->doubt);
}

/* A contact counts as the next bounce if it comes at that share of the time of flight, or less
 * off it. */
static const double RETURN_SHARE = 0.2;

/* Refuses an acceleration that holds several bounces: it does not tell them from sub-impacts, which
 * come sooner than gravity brings A back. */
static bool check_returns(const struct table *table, size_t row,
                          const struct history_impacts *found, double speed,
                          struct measured_remarks *remarks)
{
    const double gravity = column_gravity(table->layout.source->map);
    double leaves = -speed;
    for (size_t k = 0; !found->of_b && found->list[0].approach == 0.0 && k + 1 < found->count;
         k++) {
        leaves += found->list[k].jump;
        double flight = 2.0 * leaves / gravity;
        double after = found->list[k + 1].start - found->list[k].end;
        if (leaves > 0.0 && fabs(after - flight) < RETURN_SHARE * flight)
            return remarks_wrong(remarks,
                                 "%s:%zu: history: a contact %.3g s after another, when gravity "
                                 "brings A back: cut it off before, as accelerations tell one "
                                 "impact alone",
                                 text_name(table->layout.source->file), table->numbers[row], after);
    }
    return true;
}

/* Refuses numbers of one impact in a row of several bounces: only the place is of all. */
static bool check_several(const char *file, size_t line, const struct measured_impact *impact,
                          struct measured_remarks *remarks)
{
    struct measured_impact place = measured_impact_unknown();
    const double *told = (const double *)impact, *none = (const double *)&place;
    place.at = impact->at;
    for (size_t i = 0; i < sizeof *impact / sizeof(double); i++)
        if (isnan(told[i]) != isnan(none[i]))
            return remarks_wrong(remarks,
                                 "%s:%zu: history: holds several impacts: the row may say no more "
                                 "of them than 'at'",
                                 text_name(file), line);
    return true;
}

/* What the row states with that column; 0: nothing. */
static double doubt_about(const struct table *table, int kind)
{
    const struct column_map *map = table->layout.source->map;
    return map ? map->uncertainty[kind] : 0.0;
}

static bool refuse_beside(const struct table *table, size_t row, const char *one, const char *other,
                          struct measured_remarks *remarks)
{
    return remarks_wrong(remarks, "%s:%zu: %s: must be absent beside %s: both say the same",
                         text_name(table->layout.source->file), table->numbers[row], one, other);
}

/* The speeds of a fall and of a rise. Any body B takes up momentum: A's own tells the impulse. */
static bool take_heights(const struct table *table, size_t row, struct measured_impact *impact,
                         struct measured_remarks *remarks)
{
    const double gravity = column_gravity(table->layout.source->map);
    if (!isnan(impact->drop) && !isnan(impact->speed))
        return refuse_beside(table, row, "drop", "speed", remarks);
    if (!isnan(impact->drop))
        impact->speed = fall_speed(impact->drop, gravity);
    if (isnan(impact->rebound))
        return true;
    if (!isnan(impact->restitution) || !isnan(impact->v_out) || !isnan(impact->impulse))
        return refuse_beside(table, row, "rebound", "restitution, v_out or impulse", remarks);
    const double height = impact->speed * impact->speed / (2.0 * gravity);
    if (impact->rebound > height)
        return remarks_wrong(
            remarks, "%s:%zu: rebound: %.10g m: must be at most the %.4g m that A fell",
            text_name(table->layout.source->file), table->numbers[row], impact->rebound, height);
    if (!isnan(impact->speed))
        impact->momentum = impact->speed + fall_speed(impact->rebound, gravity);
    return true;
}

/* 0 where nothing is known of one of them. */
static double share_of(double half, double value)
{
    return value > 0.0 ? half / value : 0.0;
}

/* How the stated uncertainties add up, of 1 + e as a share. NAN: none was stated. */
static double doubt_of(const struct table *table, const struct measured_impact *impact)
{
    const double e = impact->restitution, gravity = column_gravity(table->layout.source->map);
    const double height = doubt_about(table, IMPACT_REBOUND),
                 stated = doubt_about(table, IMPACT_RESTITUTION);
    /* of a speed half of its height's */
    const double speed = isnan(impact->drop)
                             ? share_of(doubt_about(table, IMPACT_SPEED), impact->speed)
                             : 0.5 * share_of(doubt_about(table, IMPACT_DROP), impact->drop);
    const double rise = 0.5 * (fall_speed(impact->rebound + height, gravity) -
                               fall_speed(fmax(0.0, impact->rebound - height), gravity));
    double doubt = speed;
    if (!isnan(impact->v_out))
        doubt =
            e / (1.0 + e) * hypot(share_of(doubt_about(table, IMPACT_V_OUT), impact->v_out), speed);
    else if (!isnan(e))
        doubt = stated / (1.0 + e);
    else if (!isnan(impact->impulse))
        doubt = hypot(share_of(doubt_about(table, IMPACT_IMPULSE), impact->impulse), speed);
    else if (!isnan(impact->rebound))
        doubt = hypot(rise, (impact->momentum - impact->speed) * speed) / impact->momentum;
    return doubt > 0.0 ? doubt : NAN;
}

/* The restitution of Newton where the row does not state it. */
static bool take_v_out(struct table *table, size_t row, struct measured_impact *impact,
                       struct measured_remarks *remarks)
{
    const double most = IMPACT_KINDS[IMPACT_RESTITUTION].high;
    double e = impact->v_out / impact->speed;
    if (!isnan(impact->restitution) || isnan(e))
        return true;
    if (e > most)
        return remarks_wrong(remarks,
                             "%s:%zu: v_out: %g: must be at most %g times the speed (%g m/s)",
                             text_name(table->layout.source->file), table->numbers[row],
                             impact->v_out, most, impact->speed);
    impact->restitution = e;
    table_look(table, row, IMPACT_RESTITUTION, e);
    return true;
}

/* Reads all of the row, so that all that is wrong with it is said: an impact, and the sub-impacts
 * of its history. */
static bool read_row(struct table *table, size_t row, struct measured_impact *impact,
                     struct history_impacts *found, struct measured_remarks *remarks)
{
    const struct table_source *source = table->layout.source;
    const char *history = table_cell(table, row, IMPACT_HISTORY);
    bool good = true;
    *impact = measured_impact_unknown();
    found->count = 0;
    for (size_t k = 0; k < IMPACT_HISTORY; k++)
        good =
            table_number(table, row, k, (double *)((char *)impact + OFFSETS[k]), remarks) && good;
    good = good && take_heights(table, row, impact, remarks) &&
           take_v_out(table, row, impact, remarks);
    if (good)
        impact->doubt = doubt_of(table, impact);
    /* the numbers that its history adds */
    if (*history && !cell_is_missing(history))
        good = find_history(source->file, history, source->map, found, remarks) && good;
    for (size_t k = 1; good && k < found->count; k++)
        if (found->list[k].begins)
            return check_several(source->file, table->numbers[row], impact, remarks);
    return good;
}

/* The necessary number that the impact lacks; LACKS: none. */
static int find_lack(const struct measured_impact *impact)
{
    if (isnan(impact->speed))
        return LACKS_SPEED;
    bool outcome =
        !isnan(impact->restitution) || !isnan(impact->impulse) || !isnan(impact->momentum);
    return outcome ? LACKS : LACKS_OUTCOME;
}

/* False with the fault where no row could describe an impact. */
static bool check_columns(const struct table *table, struct measured_remarks *remarks)
{
    char list[256];
    const char *file = text_name(table->layout.source->file);
    bool history = table_has(table, IMPACT_HISTORY);
    layout_list(&table->layout, true, list, sizeof list);
    if (table_has(table, IMPACT_BOUNCE))
        return true;
    if (!history && !table_has(table, IMPACT_SPEED) && !table_has(table, IMPACT_DROP))
        return remarks_wrong(remarks,
                             "%s: column 'speed', 'drop' or 'history': missing; there are %s; "
                             "--column speed=HEADING says which it is",
                             file, list);
    if (!history && !table_has(table, IMPACT_RESTITUTION) && !table_has(table, IMPACT_IMPULSE) &&
        !table_has(table, IMPACT_V_OUT) && !table_has(table, IMPACT_REBOUND))
        return remarks_wrong(
            remarks,
            "%s: column 'restitution', 'v_out', 'rebound', 'impulse' or 'history': missing; there "
            "are %s; --column restitution=HEADING says which it is",
            file, list);
    return true;
}

/* Counts and names the rows that are left out. */
static void note_left(const struct table *table, const struct measured_set *set,
                      struct measured_remarks *remarks)
{
    struct left_out left[LACKS] = {{0}};
    char text[400] = "";
    for (size_t i = 0; i < set->left_count; i++)
        for (int lack = 0; lack < LACKS; lack++)
            if (set->left[i].reason == REASONS[lack])
                left_out_add(&left[lack], set->left[i].line);
    for (int lack = 0; lack < LACKS; lack++)
        left_out_tell(&left[lack], REASONS[lack], text, sizeof text);
    if (set->left_count > 0)
        remarks_note(remarks, "%s: %zu of %zu rows left out: %s",
                     text_name(table->layout.source->file), set->left_count, table->rows, text);
}

static bool take_rows(struct table *table, struct measured_set *set,
                      struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file);
    size_t errors = remarks->errors;
    set->left = calloc(table->rows + 1, sizeof *set->left);
    if (!set->left)
        return remarks_wrong(remarks, "%s: out of memory", file);
    /* an impact a row, or several of its history */
    for (size_t row = 0; row < table->rows; row++) {
        struct measured_impact stated;
        struct history_impacts found;
        size_t next = 0;
        if (!read_row(table, row, &stated, &found, remarks))
            continue;
        do {
            struct measured_impact impact = stated;
            if (found.count > 0 && !check_returns(table, row, &found, stated.speed, remarks))
                break;
            if (found.count > 0) {
                impact.doubt = NAN;
                struct measured_impact told = measured_impact_from(&found, &next);
                add_doubt(&stated, &told);
                fill_unknown(&told, &impact);
            }
            int lack = find_lack(&impact);
            if (lack < LACKS)
                set->left[set->left_count++] =
                    (struct measured_left){table->numbers[row], REASONS[lack]};
            else if (!measured_append(set, &impact))
                return remarks_wrong(remarks, "%s: out of memory", file);
        } while (next < found.count);
    }
    note_left(table, set, remarks);
    table_note_unusual(table, remarks);
    if (remarks->errors == errors && set->count == 0)
        return remarks_wrong(remarks, "%s: no impacts: at least one line is needed", file);
    return true;
}

/* Touches of one fall. */

/* Their instants, and the first one's fall. */
struct touches {
    size_t count;
    double *times;
    double drop; /* NAN: not known */
};

/* A column that a list of touches cannot have beside it; NULL: none. */
static const char *unfit_column(const struct table *table)
{
    for (size_t k = 0; k < IMPACT_COLUMNS; k++)
        if (table_has(table, k) && k != IMPACT_BOUNCE && k != IMPACT_DROP)
            return IMPACT_KINDS[k].name;
    return NULL;
}

/* False with the faults: no instants, or in another order. */
static bool take_touches(struct table *table, struct touches *touches,
                         struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file), *unfit = unfit_column(table);
    if (unfit)
        return remarks_wrong(remarks,
                             "%s: column '%s': must be absent beside 'bounce', but for 'drop'",
                             file, unfit);
    bool good = true;
    touches->drop = NAN;
    for (size_t row = 0; row < table->rows; row++) {
        double *time = &touches->times[touches->count], drop;
        good = table_number(table, row, IMPACT_BOUNCE, time, remarks) && good;
        good = table_number(table, row, IMPACT_DROP, &drop, remarks) && good;
        if (!isnan(drop) && row > 0)
            good = remarks_wrong(remarks, "%s:%zu: drop: must be that of the first touch alone",
                                 file, table->numbers[row]);
        if (row == 0)
            touches->drop = drop;
        /* one that is not there would join two flights */
        if (isnan(*time))
            good = remarks_wrong(remarks, "%s:%zu: bounce: missing: no touch may be left out", file,
                                 table->numbers[row]);
        else if (row > 0 && !(*time > time[-1]))
            good =
                remarks_wrong(remarks, "%s:%zu: bounce: %.10g: must be later than the line before",
                              file, table->numbers[row], *time);
        touches->count++;
    }
    return good;
}

/* The impact of touch k, of speeds half of gravity times the flights before and after it. With t
 * the touches before, at and after it 1 + e = (t2 - t0)/(t1 - t0). */
static struct measured_impact impact_between(const struct table *table,
                                             const struct touches *touches, size_t k)
{
    struct measured_impact impact = measured_impact_unknown();
    const double half = doubt_about(table, IMPACT_BOUNCE), *t = &touches->times[k];
    const double gravity = column_gravity(table->layout.source->map), rise = t[1] - t[0];
    if (k == 0) {
        impact.drop = touches->drop;
        impact.speed = fall_speed(impact.drop, gravity);
        double e = 0.5 * gravity * rise / impact.speed;
        impact.doubt =
            e / (1.0 + e) *
            hypot(sqrt(2.0) * half / rise, 0.5 * doubt_about(table, IMPACT_DROP) / impact.drop);
    } else {
        double fall = t[0] - t[-1], both = t[1] - t[-1];
        impact.speed = 0.5 * gravity * fall;
        impact.doubt = half * hypot(hypot(1.0 / both, 1.0 / fall), 1.0 / fall - 1.0 / both);
    }
    impact.momentum = impact.speed + 0.5 * gravity * rise;
    if (!(impact.doubt > 0.0))
        impact.doubt = NAN;
    return impact;
}

/* Every touch between two others, and the first one if its fall is known. */
static bool take_bounces(struct table *table, struct measured_set *set,
                         struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file);
    struct touches touches = {0, calloc(table->rows + 1, sizeof(double)), NAN};
    if (!touches.times)
        return remarks_wrong(remarks, "%s: out of memory", file);
    bool good = take_touches(table, &touches, remarks);
    for (size_t k = isnan(touches.drop) ? 1 : 0; good && k + 1 < touches.count; k++) {
        struct measured_impact impact = impact_between(table, &touches, k);
        /* a body at rest gives no more back; instants are off by what is stated */
        if (impact.momentum / impact.speed * (1.0 - (isnan(impact.doubt) ? 0.0 : impact.doubt)) >
            2.0)
            good = remarks_wrong(remarks,
                                 "%s:%zu: bounce: %.4g m/s away after %.4g m/s towards B: A rises "
                                 "higher than it fell: is a touch missing?",
                                 file, table->numbers[k + 1], impact.momentum - impact.speed,
                                 impact.speed);
        else if (!measured_append(set, &impact))
            good = remarks_wrong(remarks, "%s: out of memory", file);
    }
    free(touches.times);
    if (good && set->count == 0)
        good =
            remarks_wrong(remarks, "%s: bounce: %zu touches: three are needed, or two and the drop",
                          file, table->rows);
    return good;
}

/* A file that is a history itself. */
static bool read_history(const char *file, const struct column_map *map, struct measured_set *set,
                         struct measured_remarks *remarks)
{
    struct history_impacts found;
    struct measured_fault fault;
    struct history history;
    if (!history_read(file, map, &history, remarks))
        return false;
    bool good = history_find(&history, &found, &fault);
    bool of_b = history.of_b || history.acceleration_a;
    history_free(&history);
    if (!good)
        return remarks_wrong(remarks, "%s: %.400s", text_name(file), fault.text);
    if (of_b)
        return remarks_wrong(remarks,
                             "%s: tells no speed of A: a file with the columns speed, or drop, and "
                             "history is needed",
                             text_name(file));
    for (size_t next = 0; next < found.count;) {
        const struct measured_impact impact = measured_impact_from(&found, &next);
        if (!measured_append(set, &impact))
            return remarks_wrong(remarks, "%s: out of memory", text_name(file));
    }
    return true;
}

/* Whether the headings are those of a history, and not of impacts. Standard input is read once. */
static bool is_history(const char *file, const struct column_map *map)
{
    const struct table_source impacts = {file, IMPACT_KINDS, IMPACT_COLUMNS, map};
    const struct table_source history = {file, HISTORY_KINDS, HISTORY_COLUMNS, map};
    struct measured_remarks unsaid = {0};
    struct table table;
    if (!strcmp(file, "-"))
        return false;
    if (table_read(&impacts, &table, &unsaid)) {
        table_free(&table);
        return false;
    }
    bool is = table_read(&history, &table, &unsaid);
    if (is)
        table_free(&table);
    /* or else a faulty one, of which a column was described */
    for (int k = 0; !is && k < HISTORY_COLUMNS; k++)
        is = column_map_find(map, &HISTORY_KINDS[k]);
    return is;
}

bool measured_read(const char *file, const struct column_map *map, struct measured_set *set,
                   struct measured_remarks *remarks)
{
    const struct table_source source = {file, IMPACT_KINDS, IMPACT_COLUMNS, map};
    struct table table;
    size_t errors = remarks->errors;
    *set = (struct measured_set){0};
    if (is_history(file, map)) {
        if (!read_history(file, map, set, remarks))
            measured_set_free(set);
        return remarks->errors == errors;
    }
    if (!table_read(&source, &table, remarks))
        return false;
    if (check_columns(&table, remarks)) {
        if (table_has(&table, IMPACT_BOUNCE))
            take_bounces(&table, set, remarks);
        else
            take_rows(&table, set, remarks);
    }
    table_free(&table);
    if (remarks->errors == errors)
        return true;
    measured_set_free(set);
    return false;
}

/* Speeds of the rows that have one; room for a row each. */
static size_t take_speeds(struct table *table, double *speeds, struct measured_remarks *remarks)
{
    const char *file = text_name(table->layout.source->file);
    struct left_out left = {0};
    char text[400] = "";
    size_t count = 0;
    for (size_t row = 0; row < table->rows; row++) {
        size_t errors = remarks->errors;
        table_number(table, row, IMPACT_SPEED, &speeds[count], remarks);
        if (!isnan(speeds[count]))
            count++;
        else if (remarks->errors == errors)
            left_out_add(&left, table->numbers[row]);
    }
    left_out_tell(&left, REASONS[LACKS_SPEED], text, sizeof text);
    if (left.count > 0)
        remarks_note(remarks, "%s: %zu of %zu rows left out: %s", file, left.count, table->rows,
                     text);
    table_note_unusual(table, remarks);
    if (count == 0)
        remarks_wrong(remarks, "%s: no speeds: at least one line is needed", file);
    return count;
}

bool measured_read_speeds(const char *file, const struct column_map *map, double **speeds,
                          size_t *count, struct measured_remarks *remarks)
{
    const struct table_source source = {file, IMPACT_KINDS, IMPACT_SPEED + 1, map};
    struct table table;
    size_t errors = remarks->errors;
    *speeds = NULL;
    if (!table_read(&source, &table, remarks))
        return false;
    *speeds = calloc(table.rows + 1, sizeof **speeds);
    if (*speeds)
        *count = take_speeds(&table, *speeds, remarks);
    else
        remarks_wrong(remarks, "%s: out of memory", text_name(file));
    table_free(&table);
    if (remarks->errors == errors)
        return true;
    free(*speeds);
    *speeds = NULL;
    return false;
}

void measured_complete(struct measured_impact *impact, double mass, double w)
{
    if (isnan(impact->impulse))
        impact->impulse = isnan(impact->restitution)
                              ? mass * impact->momentum
                              : (1.0 + impact->restitution) * impact->speed / w;
    if (isnan(impact->restitution))
        impact->restitution = impact->impulse * w / impact->speed - 1.0;
    if (isnan(impact->first_impulse))
        impact->first_impulse =
            impact->sub_impacts == 1.0 ? impact->impulse : mass * impact->first_momentum;
}

double measured_half_width(const struct measured_impact *impact)
{
    return fabs(1.0 + impact->restitution) * impact->doubt;
}
