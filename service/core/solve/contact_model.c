/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "solve/contact_model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/extremes.h"
#include "contact/law_closed_form.h"
#include "contact/law_own.h"
#include "contact/plastic.h"
#include "impact/contact_step.h"
#include "model/vector.h"
#include "solve/outcome.h"
#include "solve/radiation.h"
#include "solve/rate.h"

/* A hit counts as central up to this share of the radius: the correction is of second order in it.
 */
static const double CENTRAL = 0.1;
/* Fewer modes of a mesh are not tried: they leave its flexibility to one spring. */
enum { LEAST_MODES = 6 };
/* And as on an end face from this part of the length on: the rest is its rounding. */
static const double END = 0.45;

static const struct contact_law_operations *asked_of(const struct problem *problem)
{
    return contact_law_asked(problem->request->options.contact_model);
}

/* Index of the nearest dent with a patch that covers the site, or the number of dents. */
static size_t find_dent(const struct body_state *state, const double point[3])
{
    size_t found = state->dents;
    double nearest = INFINITY;
    for (size_t i = 0; i < state->dents; i++) {
        const struct dent *dent = &body_state_dents(state)[i];
        double arm[3];
        sub3(point, dent->point, arm);
        double distance = norm3(arm);
        if (distance <= dent->size && distance < nearest) {
            nearest = distance;
            found = i;
        }
    }
    return found;
}

/* Dents of earlier impacts under a contact: those of both bodies lower the surface; that of the
 * yielding body sets the law's history. */
static void find_dents(struct problem *problem, size_t c)
{
    struct contact_model *model = &problem->contact_model;
    struct contact_choice *choice = &model->choices[c];
    for (int which = 0; which < 2 && problem->request->options.dents == PERCUSS_DENTS_KEEP;
         which++) {
        /* the dent there, if the state has one */
        const struct contact_side *side = &problem->sides[c][which];
        const struct body_state *state = problem->request->bodies[side->body].state;
        size_t i = state ? find_dent(state, side->site.point) : 0;
        if (!state || i == state->dents)
            continue;
        /* by which the surface is lower */
        const struct dent *dent = &body_state_dents(state)[i];
        model->depth[c] += dent->history.dent;
        /* and from which the law of the body that yields goes on */
        if (which != choice->side)
            continue;
        choice->dented = true;
        choice->dent = i;
        contact_law_remember(&choice->plastic, &dent->history);
    }
}

/* The table of just these materials as they are stated, for the contact's curvature; NULL: there is
 * none. */
static const struct contact_curves *look_up(const struct problem *problem,
                                            const struct contact_table_source *tables, size_t c)
{
    const double *curvature = problem->hertz[c].curvature;
    struct contact_pair pair = {problem_material(problem, c, 0),
                                problem_material(problem, c, 1),
                                {curvature[0], curvature[1]}};
    bool yields = closed_form_softer(pair.a, pair.b) >= 0;
    if (asked_of(problem)->tables == CONTACT_TABLES_NONE || !yields || !tables)
        return NULL;
    return tables->find(tables->context, &pair);
}

/* A table of just these materials, at the stress at which the softer one yields now. Where both
 * flow, and are raised by different factors, it is of other ones. */
static enum percuss_status find_table(struct problem *problem,
                                      const struct contact_table_source *tables,
                                      const struct contact_curves *curves, size_t c,
                                      struct fault *fault)
{
    struct contact_choice *choice = &problem->contact_model.choices[c];
    const struct hertz_contact *hertz = &problem->hertz[c];
    const struct body *a = problem_body(problem, c, 0);
    const struct body *b = problem_body(problem, c, 1);
    const double *raised = problem->contact_model.rates[c].raised;
    struct contact_law law;
    if (curves && raised[0] != raised[1] && tables->family &&
        contact_family_both_yield(problem_material(problem, c, 0), problem_material(problem, c, 1)))
        curves = NULL;
    if (curves)
        law = contact_law_table_at(curves, 0.5 / hertz->curvature[0]);
    if (curves && raised[choice->side] > 1.0)
        law = contact_law_rescaled(&law, 1.0, raised[choice->side]);
    /* one that ends before it yields says less than the family */
    if (curves && (!tables->family || contact_law_table_range(&law) > choice->yield)) {
        choice->plastic = law;
        choice->tabulated = true;
    } else if (asked_of(problem)->tables == CONTACT_TABLES_ONLY) {
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.contact_model: table: there is no table for %s on %s "
                         "(contacts[%zu]): %s; auto or closed-form do without",
                         a->id, b->id, c,
                         hertz->axis_ratio < HERTZ_CIRCULAR_RATIO
                             ? "the contact is elliptic, tables are of circular ones"
                             : "percuss-tables computes them");
    }
    return PERCUSS_OK;
}

/* The family's law: in use by auto, for comparison where the closed form is asked for. */
static bool find_family(struct problem *problem, const struct contact_family *family, size_t c,
                        bool used)
{
    struct contact_choice *choice = &problem->contact_model.choices[c];
    /* the curves at the place of these materials */
    const struct material *a = problem_material(problem, c, 0);
    const struct material *b = problem_material(problem, c, 1);
    struct contact_family_place place = contact_family_place(a, b);
    const struct contact_curves *curves = contact_family_curves(family, &place, problem->arena);
    if (!curves)
        return false;
    struct contact_law law = contact_law_family(curves, &problem->hertz[c], a, b);
    /* to compare with */
    if (!used) {
        choice->compared = law;
        return true;
    }
    /* in use, with its sources of uncertainty */
    choice->plastic = law;
    choice->tabulated = choice->family = true;
    choice->outside = contact_family_outside(family, &place);
    choice->both = contact_family_both_yield(a, b);
    return true;
}

/* Contacts with friction by CVODE, which has none beside a law with a loss. */
static size_t rubbing(const struct problem *problem)
{
    bool cvode = problem->request->options.method == PERCUSS_METHOD_CVODE;
    return cvode ? problem->friction_count : 0;
}

/* The catalogue's law of the two materials, for auto and where it is asked for. */
static enum percuss_status find_own(struct problem *problem, const struct body_set *catalogue,
                                    size_t c, struct fault *fault)
{
    struct contact_choice *choice = &problem->contact_model.choices[c];
    const struct material *a = problem_material(problem, c, 0);
    const struct material *b = problem_material(problem, c, 1);
    bool asked = asked_of(problem)->model == PERCUSS_CONTACT_LAW;
    if (!asked && asked_of(problem)->model != PERCUSS_CONTACT_AUTO)
        return PERCUSS_OK;
    const struct own_law *own = body_set_law(catalogue, a, b);
    if (!own && asked)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "options.contact_model: law: the catalogue has no law between %s and %s "
                         "(contacts[%zu]); auto does without",
                         a->name, b->name, c);
    if (!own)
        return PERCUSS_OK;
    const struct contact_curves *curves;
    enum percuss_status status = prepared_curves_get(problem->cache, own, &curves, fault);
    if (status)
        return status;
    struct contact_law law = contact_law_own(own, curves);
    const char *why = contact_law_refuses(&law, rubbing(problem));
    if (why)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "contacts[%zu]: the law %s, which has a dissipation: %s (another "
                         "options.contact_model leaves the law out)",
                         c, own->name, why);
    /* friction's cells are the growth of a contact from a point on */
    bool cells = problem->request->options.friction != PERCUSS_FRICTION_PLAIN;
    if (problem->friction_count > 0 && cells && !curves && own->exponent == 1.0)
        return fault_set(fault, PERCUSS_BAD_REQUEST,
                         "contacts[%zu]: the law %s has exponent 1: with micro-slip it must be "
                         "above 1 (options.friction plain or none)",
                         c, own->name);
    choice->own = own;
    choice->plastic = law;
    choice->side = -1;
    choice->yield = INFINITY;
    return PERCUSS_OK;
}

static enum percuss_status find_law(struct problem *problem, const struct body_set *catalogue,
                                    const struct contact_table_source *tables, size_t c,
                                    struct fault *fault)
{
    struct contact_choice *choice = &problem->contact_model.choices[c];
    enum percuss_status found = find_own(problem, catalogue, c, fault);
    if (found || choice->own) {
        find_dents(problem, c);
        return found;
    }
    const struct hertz_contact *hertz = &problem->hertz[c];
    const struct material *a = problem_material(problem, c, 0);
    const struct material *b = problem_material(problem, c, 1);
    const struct contact_law_operations *asked = asked_of(problem);
    /* the law itself, or its substitute */
    const struct contact_curves *curves = look_up(problem, tables, c);
    problem->contact_model.rates[c] = rate_raise(problem, c, problem_touching_speed(problem, c));
    choice->side = closed_form_softer(a, b);
    choice->yield = closed_form_yield(hertz, a, b);
    choice->plastic = asked->make(hertz, a, b);
    /* a table of these materials in its place */
    bool may = asked->tables != CONTACT_TABLES_NONE;
    if (may && choice->side >= 0) {
        enum percuss_status status = find_table(problem, tables, curves, c, fault);
        if (status)
            return status;
    }
    /* or the family: in use, or for comparison */
    if (choice->side >= 0 && !choice->tabulated && tables && tables->family &&
        !find_family(problem, tables->family, c, may))
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* from the dents that are there */
    find_dents(problem, c);
    return PERCUSS_OK;
}

/* ---- What the materials lose ---- */

/* Smaller loss factors take less than steps and modes leave, and are none. */
static const double LEAST_LOSS = 1e-9;

/* A body's relaxation, and its instantaneous modulus over `young`, which is that of the contact's
 * frequency. */
static struct relaxation relaxation_of(const struct body *body, double omega, double *instantaneous)
{
    struct relaxation relaxation = {0};
    *instantaneous = 1.0;
    if (body->relaxation.count > 0) {
        relaxation = relaxation_near(&body->relaxation, omega, instantaneous);
        *instantaneous *= body->relaxed_from / body->material.young;
    } else if (body->loss_factor > LEAST_LOSS) {
        relaxation = relaxation_constant(body->loss_factor, omega);
        *instantaneous = 1.0 / relaxation_storage(&relaxation, omega);
    }
    return relaxation;
}

static bool states_loss(const struct problem *problem, size_t c)
{
    return problem_body(problem, c, 0)->loss_factor > LEAST_LOSS ||
           problem_body(problem, c, 1)->loss_factor > LEAST_LOSS;
}

/* Why no contact can lose what its materials do; NULL: one can. */
static const char *why_lossless(const struct problem *problem)
{
    bool stated = false;
    for (size_t c = 0; c < problem->contact_count; c++)
        stated = stated || states_loss(problem, c);
    if (!stated)
        return "the material of a body must state a loss_factor above 0 or a relaxation";
    const struct contact_law law = contact_law_viscoelastic(0.0, NULL);
    return contact_law_refuses(&law, rubbing(problem));
}

/* The law of a contact whose bodies state a loss. False: out of memory. */
static bool find_loss(struct problem *problem, size_t c)
{
    struct contact_loss *loss = arena_take(problem->arena, 1, sizeof *loss);
    double omega = problem_frequency_near(problem, c);
    problem->contact_model.choices[c].loss = loss;
    if (!loss)
        return false;
    double compliance[2], before = 0.0;
    struct relaxation own[2];
    for (int which = 0; which < 2; which++) {
        const struct material *material = problem_material(problem, c, which);
        double stiffer, at = (1.0 - material->poisson * material->poisson) / material->young;
        own[which] = relaxation_of(problem_body(problem, c, which), omega, &stiffer);
        compliance[which] = at / stiffer;
        before += at;
    }
    double sudden = compliance[0] + compliance[1];
    loss->relaxation = relaxation_in_series(&own[0], compliance[0] / sudden, &own[1]);
    loss->frequency = 0.5 * omega / M_PI;
    loss->loss_factor = relaxation_loss_factor(&loss->relaxation, omega);
    loss->law =
        contact_law_viscoelastic(problem->hertz[c].stiffness * before / sudden, &loss->relaxation);
    return true;
}

static enum percuss_status find_lossy(struct problem *problem, struct fault *fault)
{
    bool asked = asked_of(problem)->model == PERCUSS_CONTACT_VISCOELASTIC;
    const char *why = why_lossless(problem);
    if (why && asked)
        return fault_set(fault, PERCUSS_BAD_REQUEST, "options.contact_model: viscoelastic: %s",
                         why);
    if (why || !(asked || asked_of(problem)->yields_if_needed))
        return PERCUSS_OK;
    for (size_t c = 0; c < problem->contact_count; c++)
        if (states_loss(problem, c) && problem_frequency_near(problem, c) > 0.0 &&
            !find_loss(problem, c))
            return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    return PERCUSS_OK;
}

/* ---- The laws in use ---- */

static void use_laws(struct problem *problem, bool yielding)
{
    struct contact_model *model = &problem->contact_model;
    model->yielding = yielding;
    bool asked = asked_of(problem)->model == PERCUSS_CONTACT_VISCOELASTIC;
    for (size_t c = 0; c < problem->contact_count; c++) {
        const struct contact_choice *choice = &model->choices[c];
        if (choice->own)
            model->laws[c] = choice->plastic;
        else if (choice->loss && (asked || !yielding || !choice->yields))
            model->laws[c] = choice->loss->law;
        else
            model->laws[c] =
                yielding ? choice->plastic : contact_law_hertz(problem->hertz[c].stiffness);
    }
}

enum percuss_status contact_model_choose(struct problem *problem, const struct body_set *catalogue,
                                         const struct contact_table_source *tables,
                                         struct fault *fault)
{
    size_t n = problem->contact_count;
    struct contact_model *model = &problem->contact_model;
    model->remedy = tables && tables->remedy.command ? &tables->remedy : NULL;
    model->depth = arena_take(problem->arena, n, sizeof *model->depth);
    model->laws = arena_take(problem->arena, n, sizeof *model->laws);
    model->choices = arena_take(problem->arena, n, sizeof *model->choices);
    model->rates = arena_take(problem->arena, n, sizeof *model->rates);
    if (!model->depth || !model->laws || !model->choices || !model->rates)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    /* the laws of every contact, and whether they are likely to be needed */
    bool dented = false;
    bool likely = false;
    for (size_t c = 0; c < n; c++) {
        enum percuss_status status = find_law(problem, catalogue, tables, c, fault);
        if (status)
            return status;
        struct contact_choice *choice = &model->choices[c];
        choice->yields =
            problem_indentation(problem, c, smaller(0.0, problem->gap_rate[c])) > choice->yield;
        dented = dented || choice->dented;
        likely = likely || choice->yields;
    }
    /* what is decided now may come out as if it yielded */
    for (size_t c = 0; dented && c < n; c++)
        model->choices[c].yields = model->choices[c].side >= 0;
    enum percuss_status status = find_lossy(problem, fault);
    if (status)
        return status;
    /* in use from the beginning where asked for, dented or likely */
    model->decided = !asked_of(problem)->yields_if_needed || dented;
    use_laws(problem, model->decided || likely);
    return PERCUSS_OK;
}

bool contact_model_yielded(const struct problem *problem, const struct impact_outcome *outcome,
                           size_t contact)
{
    return outcome->laws[contact].history.max_indentation >
               problem->contact_model.laws[contact].history.max_indentation &&
           !problem->contact_model.choices[contact].own;
}

double contact_model_beyond_table(const struct impact_outcome *outcome, size_t contact)
{
    const struct contact_law *law = &outcome->laws[contact];
    if (law->operations->tables != CONTACT_TABLES_ONLY)
        return 0.0;
    double range = contact_law_table_range(law);
    double depth = larger(law->history.max_indentation, outcome_deepest(outcome, contact));
    return larger(depth / range - 1.0, 0.0);
}

bool contact_model_revise(struct problem *problem, const struct impact_outcome *outcome)
{
    struct contact_model *model = &problem->contact_model;
    if (outcome->end_reason == PERCUSS_END_LIMIT)
        return false;
    if (model->decided)
        return false;
    bool yields = false, others = false; /* of those with a loss */
    for (size_t c = 0; c < problem->contact_count; c++) {
        struct contact_choice *choice = &model->choices[c];
        bool here = model->laws[c].operations->curve ? contact_model_yielded(problem, outcome, c)
                                                     : outcome_deepest(outcome, c) > choice->yield;
        others = others || (choice->loss && here != choice->yields);
        choice->yields = here;
        yields = yields || here;
    }
    model->decided = true;
    if (yields == model->yielding && !(yields && others))
        return false;
    use_laws(problem, yields);
    return true;
}

const struct contact_law_operations *contact_model_used(const struct problem *problem)
{
    const struct contact_law *laws = problem->contact_model.laws;
    const struct contact_law_operations *used = laws[0].operations;
    for (size_t c = 1; c < problem->contact_count; c++) {
        const struct contact_law_operations *here = laws[c].operations;
        /* a law of the catalogue counts for all, then one that yields, and of those one that
         * approximates tables, then one with a loss */
        if (used->model == PERCUSS_CONTACT_LAW)
            continue;
        if (here->model == PERCUSS_CONTACT_LAW)
            used = here;
        else if (here->curve && (!used->curve || here->tables == CONTACT_TABLES_NONE))
            used = here;
        else if (here->lossy && !used->curve)
            used = here;
    }
    return used;
}

/* The contact with the largest indentation relative to that at its yield. */
static size_t hardest_hit(const struct problem *problem, const struct impact_outcome *outcome)
{
    size_t hardest = 0;
    double most = -1.0;
    for (size_t c = 0; c < problem->contact_count; c++) {
        double share = outcome_deepest(outcome, c) / problem->contact_model.choices[c].yield;
        if (share > most) {
            most = share;
            hardest = c;
        }
    }
    return hardest;
}

static void explain_elastic(const struct problem *problem, const struct impact_outcome *outcome,
                            struct text *text)
{
    double pressure = 0.0;
    size_t hardest = hardest_hit(problem, outcome);
    const struct contact_choice *choice = &problem->contact_model.choices[hardest];
    for (size_t c = 0; c < problem->contact_count; c++)
        pressure = larger(hertz_peak_pressure(&problem->hertz[c], outcome_peak_force(outcome, c)),
                          pressure);
    text_add(text, contact_model_used(problem)->title);
    text_add(text, " (peak pressure ");
    text_add_number(text, pressure / 1e6, 3);
    text_add(text, " MPa) on a half-space");
    double share = outcome_deepest(outcome, hardest) / choice->yield;
    const struct contact_law_operations *asked = asked_of(problem);
    if (choice->side < 0 && asked->curve && asked->tables == CONTACT_TABLES_NONE)
        text_add(text, ", as neither material has a yield stress");
    if (choice->side >= 0 && share <= 1.0)
        text_format(text, ", below yield (%.2g of the indentation at which %s yields)", share,
                    problem_body(problem, hardest, choice->side)->id);
    size_t lossless = 0;
    for (size_t c = 0; contact_model_used(problem)->lossy && c < problem->contact_count; c++)
        lossless += !problem->contact_model.laws[c].operations->lossy;
    if (lossless > 0)
        text_format(text, "; %zu of %zu contacts without a loss", lossless, problem->contact_count);
}

static void explain_plastic(const struct problem *problem, const struct impact_outcome *outcome,
                            struct text *text)
{
    size_t c = hardest_hit(problem, outcome);
    const struct contact_choice *choice = &problem->contact_model.choices[c];
    const struct body *body = problem_body(problem, c, choice->side < 0 ? 0 : choice->side);
    const struct contact_history *history = &outcome->laws[c].history;
    const struct contact_law_operations *used = contact_model_used(problem);
    bool tabulated = used->tables == CONTACT_TABLES_ONLY;
    /* which law, and how deep it went */
    text_add(text, "elastic-plastic contact by ");
    text_add(text, tabulated && choice->family ? "the family of tables of the contact region"
                                               : used->title);
    if (history->max_indentation > 0.0)
        text_format(text, ": indented %.3g times as deep as where %s yields, dent %.3g um",
                    history->max_indentation / choice->yield, body->id, 1e6 * history->dent);
    else
        text_add(text, ", below yield");
    /* its start and its end */
    if (choice->dented)
        text_add(text, ", in the dent of earlier impacts");
    if (contact_model_beyond_table(outcome, c) > 0.0)
        text_add(text, "; the table ends before that and goes on as a fully plastic contact");
    /* its approximations */
    if (!tabulated && asked_of(problem)->tables == CONTACT_TABLES_IF_ANY)
        text_add(text, "; no table for these bodies");
    if (problem->hertz[c].axis_ratio < HERTZ_CIRCULAR_RATIO && !used->elliptic)
        text_format(text,
                    "; elliptic: by the sphere of equal stiffness, %.3g m, at the ellipse's peak "
                    "pressure, an approximation",
                    closed_form_radius(&problem->hertz[c]));
    if (!tabulated && body->material.tangent > 0.0)
        text_format(text, "; hardening of %s left out", body->id);
}

static void explain_own(const struct problem *problem, const struct impact_outcome *outcome,
                        struct text *text)
{
    size_t c = 0, others = 0;
    while (!problem->contact_model.choices[c].own)
        c++;
    const struct contact_choice *choice = &problem->contact_model.choices[c];
    for (size_t i = 0; i < problem->contact_count; i++)
        others += problem->contact_model.choices[i].own != choice->own;
    text_format(text, "the catalogue's law %s: %s, indented %.3g mm under %.3g N",
                choice->own->name, choice->plastic.operations->title,
                1e3 * outcome_deepest(outcome, c), outcome_peak_force(outcome, c));
    if (contact_model_beyond_table(outcome, c) > 0.0)
        text_add(text, "; its points end before that");
    if (others > 0)
        text_format(text, "; %zu contacts have others", others);
}

void contact_model_explain(const struct problem *problem, const struct impact_outcome *outcome,
                           struct text *text)
{
    if (contact_model_used(problem)->model == PERCUSS_CONTACT_LAW)
        explain_own(problem, outcome, text);
    else if (contact_model_used(problem)->curve)
        explain_plastic(problem, outcome, text);
    else
        explain_elastic(problem, outcome, text);
    rate_explain(problem, hardest_hit(problem, outcome), text);
}

double contact_patch_radius(const struct problem *problem, size_t c)
{
    const struct hertz_contact *hertz = &problem->hertz[c];
    size_t n = problem->contact_count;
    double speed = problem_approach(problem);
    double energy = 0.5 * speed * speed / problem->w[c * (n + 1)];
    double force = hertz->stiffness * pow(energy / (HERTZ_WORK * hertz->stiffness), 0.6);
    double axes[2];
    hertz_ellipse(hertz, force, axes);
    return sqrt(axes[0] * axes[1]);
}

static bool is_central(const struct body *body, const double point[3])
{
    double off = hypot(point[1], point[2]);
    double length = fabs(point[0]);
    return off <= CENTRAL * body->radius && length > END * body->length;
}

/* A mesh's or a box's static compliance is the real body's beyond the half-space. */
static bool is_matched_by_nature(const struct body *body)
{
    return body_is_solid(body);
}

/* So is that of a beam's side: its theory lacks the place's own. */
static bool is_side_of_beam(const struct contact_side *side, const struct body *body)
{
    return side->site.face == SITE_BEAM_SIDE && body_bends(body) &&
           body->theory == THEORY_TIMOSHENKO;
}

static double side_of_beam(const struct problem *problem, const struct contact_side *side)
{
    const struct site *site = &side->site;
    return problem->compliance.bare
               ? 0.0
               : beam_side_compliance(problem->bodies[side->body], site->point, site->outward);
}

/* The correction of one side of a contact, m/N. NAN: none is known. False: out of memory. */
static bool side_compliance(struct problem *problem, size_t c, int which, double *compliance)
{
    const struct contact_side *side = &problem->sides[c][which];
    const struct body *body = problem->bodies[side->body];
    enum solid_form form = body_solid(body).form;
    /* the family holds it, for one contact radius */
    if (is_matched_by_nature(body)) {
        const struct face_spot *spot = &side->site.spot;
        const struct mesh_load *load = &side->load.family[0].mesh;
        *compliance = 0.0;
        if (load->slope != 0.0) {
            problem->compliance.by_speed = true;
            *compliance = load->slope * log(load->cut / contact_patch_radius(problem, c));
        }
        if (body->mesh && spot->slope != 0.0 && body->mesh->cut > 0.0) {
            problem->compliance.by_speed = true;
            *compliance =
                spot->slope * log(body->scale * body->mesh->cut / contact_patch_radius(problem, c));
        }
        return true;
    }
    if (is_side_of_beam(side, body)) {
        *compliance = side_of_beam(problem, side);
        return true;
    }
    *compliance = NAN;
    if (form == SOLID_CYLINDER && !is_central(body, side->site.point))
        return true;
    double patch = 0.0;
    if (form == SOLID_BALL) {
        patch = contact_patch_radius(problem, c);
        problem->compliance.by_speed = true;
    }
    return prepared_matched_get(problem->cache, body, patch, compliance);
}

/* Also without the corrections of bodies a beam keeps its own. */
static void use_half_space(struct problem *problem, const char *why)
{
    struct compliance *compliance = &problem->compliance;
    compliance->used = PERCUSS_COMPLIANCE_HALF_SPACE;
    compliance->by_speed = false;
    memset(compliance->series, 0, problem->contact_count * sizeof *compliance->series);
    memset(compliance->sides, 0, problem->contact_count * sizeof *compliance->sides);
    for (size_t c = 0; c < problem->contact_count; c++)
        for (int which = 0; which < 2; which++) {
            const struct contact_side *side = &problem->sides[c][which];
            if (is_side_of_beam(side, problem->bodies[side->body]))
                compliance->sides[c][which] = side_of_beam(problem, side);
            compliance->series[c] += compliance->sides[c][which];
        }
    compliance->reason[0] = '\0';
    if (*why) /* usually nothing is to be said */
        snprintf(compliance->reason, sizeof compliance->reason, "%s", why);
}

static bool any_flexible(const struct problem *problem, size_t c)
{
    for (int which = 0; which < 2; which++)
        if (body_is_flexible(problem->bodies[problem->sides[c][which].body]))
            return true;
    return false;
}

static bool any_mesh(const struct problem *problem)
{
    for (size_t i = 0; i < 2 * problem->contact_count; i++)
        if (is_matched_by_nature(problem_body(problem, i / 2, i % 2)))
            return true;
    return false;
}

/* A law of the catalogue is the whole indentation of its pair. */
static bool any_own(const struct problem *problem)
{
    for (size_t c = 0; c < problem->contact_count; c++)
        if (problem->contact_model.choices[c].own)
            return true;
    return false;
}

static void find_matched(struct problem *problem, bool asked)
{
    struct compliance *compliance = &problem->compliance;
    compliance->used = PERCUSS_COMPLIANCE_MATCHED;
    /* of every contact, or of none */
    for (size_t c = 0; c < problem->contact_count; c++) {
        if (!asked && !any_flexible(problem, c)) {
            use_half_space(problem, "");
            return;
        }
        for (int which = 0; which < 2; which++) {
            double *part = &compliance->sides[c][which];
            if (!side_compliance(problem, c, which, part))
                problem->arena->lacks = true;
            if (!isfinite(*part)) {
                char why[sizeof compliance->reason];
                const struct contact_side *side = &problem->sides[c][which];
                snprintf(why, sizeof why, "no matched compliance is known for %s there",
                         problem->bodies[side->body]->id);
                use_half_space(problem, why);
                return;
            }
            compliance->series[c] += *part;
        }
    }
}

enum percuss_status compliance_choose(struct problem *problem, enum percuss_compliance otherwise,
                                      struct fault *fault)
{
    struct compliance *compliance = &problem->compliance;
    size_t n = problem->contact_count;
    *compliance =
        (struct compliance){.series = arena_take(problem->arena, n, sizeof *compliance->series),
                            .sides = arena_take(problem->arena, n, sizeof *compliance->sides)};
    if (!compliance->series || !compliance->sides)
        return fault_set(fault, PERCUSS_INTERNAL, "out of memory");
    enum percuss_compliance asked = problem->request->options.compliance;
    enum percuss_compliance wanted = asked;
    if (asked == PERCUSS_COMPLIANCE_DEFAULT)
        wanted = any_mesh(problem) ? PERCUSS_COMPLIANCE_MATCHED : otherwise;
    if (wanted == PERCUSS_COMPLIANCE_HALF_SPACE ||
        (any_own(problem) && asked != PERCUSS_COMPLIANCE_MATCHED))
        use_half_space(problem, "");
    else
        find_matched(problem, asked == PERCUSS_COMPLIANCE_MATCHED);
    return PERCUSS_OK;
}

/* Hertz's slope at the largest force of a contact, N/m: 3/2 k^(2/3) F^(1/3), or that of unloading
 * from a dent. */
static double largest_stiffness(const struct problem *problem, const struct impact_outcome *outcome,
                                size_t c)
{
    /* the law that was in use: one that remembers is stiffer at first than Hertz's */
    const struct contact_law *law = &outcome->laws[c];
    double k = law->operations->remembers ? law->parameters[0] : problem->hertz[c].stiffness;
    double force = outcome_peak_force(outcome, c), slope = 0.0;
    if (problem->contact_model.choices[c].own) {
        contact_law_force(law, outcome_deepest(outcome, c), &slope);
        return larger(slope, contact_law_unloading(law));
    }
    return larger(1.5 * cbrt(k * k * force), contact_law_unloading(&outcome->laws[c]));
}

/* Most modes of a mesh that take part. */
static size_t mesh_modes(const struct problem *problem, const struct scene *scene)
{
    size_t most = 0;
    for (size_t g = 0; g < scene->groups; g++)
        if (body_is_solid(problem->bodies[scene->group[g].body]) && scene->group[g].count > most)
            most = scene->group[g].count;
    size_t allowed = problem->compliance.most;
    return allowed > 0 && allowed < most ? allowed : most;
}

static bool any_side(const struct problem *problem)
{
    for (size_t i = 0; i < 2 * problem->contact_count; i++)
        if (is_side_of_beam(&problem->sides[i / 2][i % 2], problem_body(problem, i / 2, i % 2)))
            return !problem->compliance.bare;
    return false;
}

bool compliance_revise(struct problem *problem, const struct scene *scene,
                       const struct impact_outcome *outcome)
{
    /* nothing else is ever taken back */
    bool radiates = radiation_is_in(problem, scene);
    bool matched = problem->compliance.used == PERCUSS_COMPLIANCE_MATCHED;
    if (!matched && !radiates && !any_side(problem) && mesh_modes(problem, scene) <= LEAST_MODES)
        return false;
    /* waves that contacts share may take all of the effort */
    if (outcome->end_reason == PERCUSS_END_LIMIT && radiation_is_shared(problem, scene)) {
        problem->compliance.still = true;
        return true;
    }
    /* too stiff a contact: without waves, then without matched compliance, then without a beam's */
    for (size_t c = 0; c < scene->contacts; c++) {
        if (!outcome->too_stiff && contact_bears(scene, c, largest_stiffness(problem, outcome, c)))
            continue;
        if (radiates)
            problem->compliance.still = true;
        else if (mesh_modes(problem, scene) > LEAST_MODES)
            problem->compliance.most = mesh_modes(problem, scene) * 2 / 3;
        else {
            problem->compliance.bare = !matched;
            use_half_space(problem,
                           "the matched compliance is too negative for so stiff a contact");
        }
        return true;
    }
    return false;
}
