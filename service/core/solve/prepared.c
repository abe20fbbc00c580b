/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/prepared.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fe/matched.h"
#include "model/bending_axes.h"
#include "model/damping.h"
#include "model/ritz_store.h"

/* Patches from a half of a sphere's radius down to 1/1024; smaller ones are extrapolated. */
enum { OCTAVES = 11 };
enum { BUCKETS = 256, ROUNDING = 8 };
/* Cached bodies with parameters of a request's own: a calibration comes back to a few. */
enum { MOST_VARIED = 32 };
/* Cached parts of groups: a body is hit at few places repeatedly, or never twice at one. */
enum { MOST_PARTS = 8 };

/* Stands for all modes from index `first` on. */
struct remainder {
    struct remainder *next;
    size_t first;
    struct oscillators *set;
};

/* A half-space's waves. */
struct radiation {
    struct radiation *next;
    int step;
    struct oscillators *set;
};

struct entry {
    struct entry *next, *next_touched;
    bool touched;     /* asked for since it was counted */
    size_t bytes;     /* as it was counted last */
    struct body body; /* a copy: its key, see body_same_modes */
    struct prepared_family *families[BODY_MOST_FAMILIES];
    struct remainder *remainders[BODY_MOST_FAMILIES];
    struct radiation *radiation;
};

/* Matched compliances of solids that are alike, in the unit of matched_unit. */
struct matched {
    struct solid solid; /* its length in radii */
    double poisson;
    bool flexible;
    bool asked[OCTAVES];   /* `share` is computed */
    double share[OCTAVES]; /* [k]: with the patch 2^-k; [0] where it does not matter */
};

/* Solids that are not alike: those of a scene, with some to spare. */
enum { SOLIDS = 16 };

/* Cached contact ellipses: enough for a scene, or for some scenes asked by turns. */
enum { CONTACTS = 16 };

/* A box that a scene may use. */
struct held {
    struct held *next;
    struct ritz_box *box;
};

/* A subset of a group's modes as a group of its own. */
struct prepared_part {
    struct prepared_part *next;
    const struct prepared_group *whole;
    struct prepared_group group;
};

struct prepared_parts {
    struct prepared_part *first;
    size_t count;
};

/* Curves of a law of the catalogue. */
struct prepared_law {
    struct prepared_law *next;
    char name[PERCUSS_ID_SIZE];
    struct contact_curves *curves;
};

struct prepared_cache {
    struct ritz_store *boxes; /* source of those held; NULL: none is in use yet */
    struct held *held;
    struct hertz_contact contacts[CONTACTS]; /* by a hash of the curvatures; all zero: none */
    struct matched matched[SOLIDS];          /* in turn */
    size_t matched_count;                    /* ever made */
    char revision[PERCUSS_ID_SIZE];
    struct entry *buckets[BUCKETS];
    struct prepared_family *retired; /* outgrown, but a scene may still point at them */
    size_t varied;                   /* entries of varied bodies */
    size_t bytes;                    /* of all entries, as they were counted last */
    struct entry *touched;           /* what has to be counted anew */
    struct prepared_parts parts;
    struct prepared_law *laws;
};

/* Participations of the first modes in one load. */
struct participation_row {
    struct family_load load; /* the key, to the last byte */
    size_t known;            /* modes; 0: there is no such load yet */
    unsigned long used;      /* count of requests at its last use */
    double *shape;           /* [modes] */
};

struct participations {
    unsigned long asked;
    struct participation_row rows[PARTICIPATION_LOADS];
    size_t *index; /* [modes]: 0, 1, ... */
    double shapes[];
};

struct participations *participations_create(size_t modes)
{
    struct participations *cached =
        calloc(1, sizeof *cached + PARTICIPATION_LOADS * modes * sizeof *cached->shapes);
    if (!cached)
        return NULL;
    cached->index = malloc((modes + 1) * sizeof *cached->index);
    if (!cached->index) {
        free(cached);
        return NULL;
    }
    for (size_t k = 0; k < modes; k++)
        cached->index[k] = k;
    for (size_t i = 0; i < PARTICIPATION_LOADS; i++)
        cached->rows[i].shape = cached->shapes + i * modes;
    return cached;
}

void participations_free(struct participations *cached)
{
    if (!cached)
        return;
    free(cached->index);
    free(cached);
}

/* NULL: there is none of that load. */
static struct participation_row *find_participations(struct participations *cached,
                                                     const struct family_load *load)
{
    for (struct participation_row *row = cached->rows; row < cached->rows + PARTICIPATION_LOADS;
         row++)
        if (row->known > 0 && memcmp(&row->load, load, sizeof *load) == 0)
            return row;
    return NULL;
}

/* A row for that load, in place of the least recently used one. */
static struct participation_row *take_participations(struct participations *cached,
                                                     const struct family_load *load)
{
    struct participation_row *oldest = cached->rows;
    for (struct participation_row *row = cached->rows; row < cached->rows + PARTICIPATION_LOADS;
         row++)
        if (row->used < oldest->used)
            oldest = row;
    memcpy(&oldest->load, load, sizeof *load);
    oldest->known = 0;
    return oldest;
}

void participations_get(struct participations *cached, const struct body *body,
                        const struct modal_family *modes, const size_t *which, size_t count,
                        const struct family_load *load, double *shape)
{
    if (count == 0)
        return;
    struct participation_row *row = find_participations(cached, load);
    size_t wanted = which[count - 1] + 1;
    /* modes before the requested ones are not computed for them */
    if (which[0] > (row ? row->known : 0)) {
        modal_participations(body, modes, which, count, load, shape);
        return;
    }
    if (!row)
        row = take_participations(cached, load);
    if (wanted > row->known) {
        modal_participations(body, modes, cached->index + row->known, wanted - row->known, load,
                             row->shape + row->known);
        row->known = wanted;
    }
    row->used = ++cached->asked;
    for (size_t i = 0; i < count; i++)
        shape[i] = row->shape[which[i]];
}

static void part_free(struct prepared_part *part)
{
    oscillators_free(part->group.set);
    free(part->group.mode);
    free(part);
}

static void parts_clear(struct prepared_parts *parts)
{
    while (parts->first) {
        struct prepared_part *next = parts->first->next;
        part_free(parts->first);
        parts->first = next;
    }
    parts->count = 0;
}

static void family_free(struct prepared_family *family)
{
    if (!family)
        return;
    for (size_t g = 0; g < family->group_count; g++) {
        oscillators_free(family->groups[g].set);
        free(family->groups[g].mode);
    }
    modal_family_free(family->modes);
    participations_free(family->participations);
    free(family);
}

static bool group_create(struct prepared_group *group, const struct body *body,
                         const struct modal_family *modes, int parity)
{
    double *omega = calloc(modes->count + 1, sizeof *omega);
    double *damping = calloc(modes->count + 1, sizeof *damping);
    group->mode = calloc(modes->count + 1, sizeof *group->mode);
    size_t count = 0;
    for (size_t k = 0; omega && damping && group->mode && k < modes->count; k++) {
        if (modes->odd[k] != parity)
            continue;
        omega[count] = modes->omega[k];
        damping[count] = damping_of(body, k, modes->omega[k]);
        group->mode[count++] = k;
    }
    if (omega && damping && group->mode)
        group->set = oscillators_create_each(count, omega, damping);
    free(omega);
    free(damping);
    return group->set != NULL;
}

/* `known`: some of them, or of a body alike; NULL: none are. */
static struct prepared_family *family_create(const struct body *body, size_t which, size_t count,
                                             const struct modal_family *known)
{
    struct prepared_family *family = calloc(1, sizeof *family);
    if (!family)
        return NULL;
    family->modes =
        known ? modal_family_grow(body, known, count) : modal_family_create(body, which, count);
    family->participations = participations_create(count);
    if (!family->modes || !family->participations) {
        family_free(family);
        return NULL;
    }
    /* even shapes in one group, odd ones in another */
    bool any_odd = false;
    for (size_t k = 0; k < count; k++)
        any_odd = any_odd || family->modes->odd[k];
    family->group_count = any_odd ? 2 : 1;
    for (size_t g = 0; g < family->group_count; g++) {
        if (!group_create(&family->groups[g], body, family->modes, (int)g)) {
            family_free(family);
            return NULL;
        }
    }
    return family;
}

struct prepared_cache *prepared_cache_create(void)
{
    return calloc(1, sizeof(struct prepared_cache));
}

static void remainders_free(struct remainder *list)
{
    while (list) {
        struct remainder *next = list->next;
        oscillators_free(list->set);
        free(list);
        list = next;
    }
}

static void entry_clear(struct entry *entry)
{
    for (int f = 0; f < BODY_MOST_FAMILIES; f++) {
        family_free(entry->families[f]);
        remainders_free(entry->remainders[f]);
        entry->families[f] = NULL;
        entry->remainders[f] = NULL;
    }
    while (entry->radiation) {
        struct radiation *next = entry->radiation->next;
        oscillators_free(entry->radiation->set);
        free(entry->radiation);
        entry->radiation = next;
    }
}

/* Forgets all bodies, or only the varied ones. */
static void forget_bodies(struct prepared_cache *cache, bool only_varied)
{
    parts_clear(&cache->parts);
    for (size_t b = 0; b < BUCKETS; b++) {
        for (struct entry **link = &cache->buckets[b]; *link;) {
            struct entry *entry = *link;
            if (only_varied && !entry->body.varied) {
                link = &entry->next;
                continue;
            }
            *link = entry->next;
            cache->bytes -= entry->bytes;
            entry_clear(entry);
            free(entry);
        }
    }
    cache->varied = 0;
}

static void forget_laws(struct prepared_cache *cache)
{
    while (cache->laws) {
        struct prepared_law *next = cache->laws->next;
        contact_curves_free(cache->laws->curves);
        free(cache->laws);
        cache->laws = next;
    }
}

static void free_retired(struct prepared_cache *cache)
{
    if (cache->retired)
        parts_clear(&cache->parts);
    while (cache->retired) {
        struct prepared_family *next = cache->retired->next_retired;
        family_free(cache->retired);
        cache->retired = next;
    }
}

/* `modes`: for which it has room. */
static size_t group_bytes(const struct prepared_group *group, size_t modes)
{
    return oscillators_bytes(group->set) + (modes + 1) * sizeof *group->mode;
}

static size_t family_bytes(const struct prepared_family *family)
{
    const size_t modes = family->modes->count;
    const struct participations *cached = family->participations;
    size_t bytes = sizeof *family + family->modes->bytes + sizeof *cached +
                   PARTICIPATION_LOADS * modes * sizeof *cached->shapes +
                   (modes + 1) * sizeof *cached->index;
    for (size_t g = 0; g < family->group_count; g++)
        bytes += group_bytes(&family->groups[g], modes);
    return bytes;
}

static size_t entry_bytes(const struct entry *entry)
{
    size_t bytes = sizeof *entry;
    for (int f = 0; f < BODY_MOST_FAMILIES; f++) {
        bytes += entry->families[f] ? family_bytes(entry->families[f]) : 0;
        for (const struct remainder *r = entry->remainders[f]; r; r = r->next)
            bytes += sizeof *r + oscillators_bytes(r->set);
    }
    for (const struct radiation *r = entry->radiation; r; r = r->next)
        bytes += sizeof *r + oscillators_bytes(r->set);
    return bytes;
}

/* Only what was asked for has grown. */
static void count_touched(struct prepared_cache *cache)
{
    for (struct entry *entry; (entry = cache->touched);) {
        const size_t bytes = entry_bytes(entry);
        cache->touched = entry->next_touched;
        cache->bytes += bytes - entry->bytes;
        entry->bytes = bytes;
        entry->touched = false;
    }
}

size_t prepared_cache_bytes(const struct prepared_cache *cache)
{
    size_t bytes = cache->bytes;
    for (const struct prepared_part *part = cache->parts.first; part; part = part->next)
        bytes += sizeof *part + group_bytes(&part->group, part->group.set->count);
    return bytes;
}

void prepared_cache_drop(struct prepared_cache *cache, bool only_varied)
{
    count_touched(cache);
    forget_bodies(cache, only_varied);
}

static void release_boxes(struct prepared_cache *cache)
{
    while (cache->held) {
        struct held *next = cache->held->next;
        ritz_store_release(cache->boxes, cache->held->box);
        free(cache->held);
        cache->held = next;
    }
}

void prepared_cache_free(struct prepared_cache *cache)
{
    if (!cache)
        return;
    release_boxes(cache);
    ritz_store_free(cache->boxes);
    free_retired(cache);
    forget_bodies(cache, false);
    forget_laws(cache);
    free(cache);
}

void prepared_cache_use(struct prepared_cache *cache, const char *revision)
{
    count_touched(cache);
    free_retired(cache);
    release_boxes(cache);
    if (cache->parts.count > MOST_PARTS)
        parts_clear(&cache->parts);
    if (cache->varied > MOST_VARIED)
        forget_bodies(cache, true);
    if (strncmp(cache->revision, revision, sizeof cache->revision) == 0)
        return;
    forget_bodies(cache, false);
    forget_laws(cache);
    snprintf(cache->revision, sizeof cache->revision, "%s", revision);
}

enum percuss_status prepared_curves_get(struct prepared_cache *cache, const struct own_law *own,
                                        const struct contact_curves **curves, struct fault *fault)
{
    struct prepared_law *law = cache->laws;
    *curves = NULL;
    if (!own->points.count)
        return PERCUSS_OK;
    while (law && strcmp(law->name, own->name) != 0)
        law = law->next;
    if (!law) {
        law = calloc(1, sizeof *law);
        if (!law)
            return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
        enum percuss_status status = own_curves_create(own, &law->curves, fault);
        if (status) {
            free(law);
            return status;
        }
        memcpy(law->name, own->name, sizeof law->name);
        law->next = cache->laws;
        cache->laws = law;
    }
    *curves = law->curves;
    return PERCUSS_OK;
}

static struct entry **find_bucket(struct prepared_cache *cache, const char *id)
{
    unsigned hash = 2166136261u;
    for (const char *c = id; *c; c++)
        hash = (hash ^ (unsigned char)*c) * 16777619u;
    return &cache->buckets[hash % BUCKETS];
}

static struct entry *touch(struct prepared_cache *cache, struct entry *entry)
{
    if (!entry->touched) {
        entry->touched = true;
        entry->next_touched = cache->touched;
        cache->touched = entry;
    }
    return entry;
}

static struct entry *find_entry(struct prepared_cache *cache, const struct body *body)
{
    struct entry **bucket = find_bucket(cache, body->id);
    for (struct entry *entry = *bucket; entry; entry = entry->next)
        if (body_same_modes(&entry->body, body))
            return touch(cache, entry);
    struct entry *entry = calloc(1, sizeof *entry);
    if (!entry)
        return NULL;
    entry->body = *body;
    entry->next = *bucket;
    *bucket = entry;
    cache->varied += body->varied;
    return touch(cache, entry);
}

/* Of the known modes that serve the body, its own or those of one alike (of the same id, with
 * another density, say), the most; NULL: none. */
static const struct modal_family *find_modes(struct prepared_cache *cache, const struct entry *own,
                                             size_t family)
{
    const struct modal_family *best = own->families[family] ? own->families[family]->modes : NULL;
    for (struct entry *entry = *find_bucket(cache, own->body.id); entry; entry = entry->next) {
        const struct prepared_family *other = entry->families[family];
        if (other && (!best || other->modes->count > best->count) &&
            modal_family_alike(&entry->body, &own->body, family))
            best = other->modes;
    }
    return best;
}

const struct prepared_family *prepared_family_get(struct prepared_cache *cache,
                                                  const struct body *body, size_t family,
                                                  size_t count)
{
    struct entry *entry = find_entry(cache, body);
    if (!entry)
        return NULL;
    /* families that are alike share theirs */
    family = bending_axes_common_family(body, family);
    size_t most = modal_family_most(body, family);
    if (count > most)
        count = most;
    struct prepared_family *known = entry->families[family];
    if (known && known->modes->count >= count)
        return known;
    /* too few: more, with some to spare */
    size_t rounded = (count + ROUNDING - 1) / ROUNDING * ROUNDING;
    struct prepared_family *made =
        family_create(body, family, rounded ? rounded : ROUNDING, find_modes(cache, entry, family));
    if (!made)
        return NULL;
    /* a scene may still point at the old ones */
    if (known) {
        known->next_retired = cache->retired;
        cache->retired = known;
    }
    entry->families[family] = made;
    return made;
}

const struct prepared_group *prepared_part_get(struct prepared_cache *cache,
                                               const struct prepared_group *whole,
                                               const size_t *which, size_t count)
{
    for (struct prepared_part *known = cache->parts.first; known; known = known->next)
        if (known->whole == whole && known->group.set->count == count &&
            memcmp(known->group.set->which, which, count * sizeof *which) == 0)
            return &known->group;
    struct prepared_part *made = calloc(1, sizeof *made);
    if (!made)
        return NULL;
    made->whole = whole;
    made->group.set = oscillators_part(whole->set, which, count);
    made->group.mode = calloc(count + 1, sizeof *made->group.mode);
    if (!made->group.set || !made->group.mode) {
        part_free(made);
        return NULL;
    }
    for (size_t i = 0; i < count; i++)
        made->group.mode[i] = whole->mode[which[i]];
    made->next = cache->parts.first;
    cache->parts.first = made;
    cache->parts.count++;
    return &made->group;
}

struct oscillators *prepared_remainder_get(struct prepared_cache *cache, const struct body *body,
                                           size_t family, size_t first)
{
    /* the frequency follows from the first mode left out */
    const struct prepared_family *modes = prepared_family_get(cache, body, family, first + 1);
    struct entry *entry = modes ? find_entry(cache, body) : NULL;
    if (!entry)
        return NULL;
    for (struct remainder *known = entry->remainders[family]; known; known = known->next)
        if (known->first == first)
            return known->set;
    /* made when first asked for */
    struct remainder *made = calloc(1, sizeof *made);
    if (!made)
        return NULL;
    double omega = modal_remainder_frequency(body, modes->modes, first);
    made->first = first;
    made->set =
        oscillators_create(1, &omega, damping_from(body, first, modes->modes->omega[first]));
    made->next = entry->remainders[family];
    if (!made->set) {
        free(made);
        return NULL;
    }
    entry->remainders[family] = made;
    return made->set;
}

struct oscillators *prepared_radiation_get(struct prepared_cache *cache, const struct body *body,
                                           int step)
{
    struct entry *entry = find_entry(cache, body);
    if (!entry)
        return NULL;
    for (struct radiation *known = entry->radiation; known; known = known->next)
        if (known->step == step)
            return known->set;
    /* made when first asked for */
    struct radiation *made = calloc(1, sizeof *made);
    if (!made)
        return NULL;
    double omega = exp2(step / PREPARED_STEPS);
    *made = (struct radiation){entry->radiation, step, oscillators_create(1, &omega, M_SQRT1_2)};
    if (!made->set) {
        free(made);
        return NULL;
    }
    entry->radiation = made;
    return made->set;
}

struct hertz_contact prepared_contact_get(struct prepared_cache *cache, double effective_modulus,
                                          const double curvature[2])
{
    /* its place by a hash of the curvatures */
    uint64_t bits[2];
    memcpy(bits, curvature, sizeof bits);
    uint64_t mixed = (bits[0] ^ bits[1] * 0x9e3779b97f4a7c15u) * 0xff51afd7ed558ccdu;
    struct hertz_contact *known = &cache->contacts[mixed >> 32 & (CONTACTS - 1)];
    if (known->effective_modulus != effective_modulus || known->curvature[0] != curvature[0] ||
        known->curvature[1] != curvature[1])
        *known = hertz_contact_make(effective_modulus, curvature[0], curvature[1]);
    return *known;
}

/* The store in use from now on; without one the cache has its own. False: out of memory. */
static bool use_boxes(struct prepared_cache *cache, struct ritz_store *store)
{
    if (cache->boxes && (cache->boxes == store || !store))
        return true;
    release_boxes(cache);
    ritz_store_free(cache->boxes);
    cache->boxes = store ? ritz_store_share(store) : ritz_store_create(RITZ_STORE_BYTES);
    return cache->boxes != NULL;
}

const struct ritz *prepared_ritz_get(struct prepared_cache *cache, struct ritz_store *store,
                                     const struct ritz_shape *shape, double poisson,
                                     struct pace *pace)
{
    struct held *held = calloc(1, sizeof *held);
    if (held && use_boxes(cache, store))
        held->box = ritz_store_hold(cache->boxes, shape, poisson, pace);
    if (!held || !held->box) {
        free(held);
        return NULL;
    }
    held->next = cache->held;
    cache->held = held;
    return ritz_box_vibration(held->box);
}

/* The box that holds a vibration; NULL: none of the cache's. */
static struct ritz_box *box_of(const struct prepared_cache *cache, const struct ritz *ritz)
{
    const struct held *held = cache->held;
    while (held && ritz_box_vibration(held->box) != ritz)
        held = held->next;
    return held ? held->box : NULL;
}

double prepared_ritz_flexibility(struct prepared_cache *cache, const struct ritz *ritz, int axis,
                                 int side, const double point[3])
{
    struct ritz_box *box = box_of(cache, ritz);
    return box ? ritz_box_flexibility(cache->boxes, box, axis, side, point)
               : ritz_flexibility(ritz, axis, side, point);
}

bool prepared_ritz_tensor(struct prepared_cache *cache, const struct ritz *ritz, int axis, int side,
                          const double point[3], double tensor[6])
{
    struct ritz_box *box = box_of(cache, ritz);
    return box ? ritz_box_tensor(cache->boxes, box, axis, side, point, tensor)
               : ritz_tensor(ritz, axis, side, point, tensor);
}

static bool solid_alike(const struct matched *known, const struct solid *solid, double poisson,
                        bool flexible)
{
    return known->solid.form == solid->form && known->solid.length == solid->length &&
           known->solid.tip_radius == solid->tip_radius &&
           known->solid.approximate == solid->approximate && known->poisson == poisson &&
           known->flexible == flexible;
}

/* That of the solids alike; if there is none the oldest gives its place. */
static struct matched *find_matched(struct prepared_cache *cache, const struct body *body)
{
    struct solid solid = body_solid(body);
    double poisson = body->material.poisson;
    bool flexible = body_is_flexible(body);
    if (solid.radius > 0.0)
        solid.length /= solid.radius;
    size_t filled = cache->matched_count < SOLIDS ? cache->matched_count : SOLIDS;
    for (size_t i = 0; i < filled; i++)
        if (solid_alike(&cache->matched[i], &solid, poisson, flexible))
            return &cache->matched[i];
    struct matched *made = &cache->matched[cache->matched_count++ % SOLIDS];
    *made = (struct matched){.solid = solid, .poisson = poisson, .flexible = flexible};
    return made;
}

/* Asks for the compliance at an octave, m/N. False: out of memory. */
static bool match_at(struct matched *known, const struct body *body, int octave, double *compliance)
{
    if (!known->asked[octave])
        known->asked[octave] = matched_share(body, ldexp(1.0, -octave), &known->share[octave]);
    *compliance = known->share[octave] * matched_unit(body);
    return known->asked[octave];
}

bool prepared_matched_get(struct prepared_cache *cache, const struct body *body, double patch,
                          double *compliance)
{
    struct matched *known = find_matched(cache, body);
    if (body_solid(body).form != SOLID_BALL)
        return match_at(known, body, 0, compliance);
    double octave = fmax(1.0, -log2(patch / body->radius));
    int below = (int)fmin(octave, OCTAVES - 2);
    double low;
    double high;
    if (!match_at(known, body, below, &low) || !match_at(known, body, below + 1, &high))
        return false;
    *compliance = low + (octave - below) * (high - low);
    return true;
}
