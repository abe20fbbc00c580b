/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

/* Mirrors service/tools/reduce/sites.c, site_field.c, site_faces.c and forked.c: the flexibility
 * that faces interpolate against the one solved for in the same place. */
#include <signal.h>
#include <unistd.h>

#include "reduce/forked.h"
#include "reduce/reduced_body.h"
#include "reduce/site_faces.h"
#include "reduce/sites.h"
#include "unit/mesh/blocks.h"
#include "unit/reduce/flexed.h"
#include "unit/reduce/solve_mesh.h"

static const double RADIUS = 0.01, YOUNG = 73e9, POISSON = 0.3;

/* a cylinder, 24 modes of it, and a body to be filled */
struct scene {
    struct flexed flexed;
    struct solved solved;
    struct mesh_body body;
    struct sites_task task;
    struct sites_report report;
    struct material material;
};

static const struct material METAL = {"metal", YOUNG, POISSON, 2700.0, INFINITY, 0.0};

/* takes the mesh over */
static void scene_prepare(struct scene *scene, struct solid_mesh *mesh)
{
    struct fault fault;
    memset(scene, 0, sizeof *scene);
    flexed_make(&scene->flexed, mesh, 1e10, false);
    assert_int_equal(surface_fit(&scene->flexed.mesh, &scene->flexed.surface, &fault), PERCUSS_OK);
    solve_mesh(&scene->flexed.mesh, 0, INFINITY, 24, &scene->solved);
    struct flexibility_body *body = &scene->flexed.body;
    body->factor = scene->solved.factor;
    body->shift = scene->solved.modes.shift;
    body->removed = scene->solved.modes.count;
    body->shapes = scene->solved.modes.shapes;
    body->omega = scene->solved.modes.omega;
    flexibility_free(scene->flexed.flexibility);
    scene->flexed.flexibility = flexibility_make(body);
    assert_non_null(scene->flexed.flexibility);
    scene->body.face_count = scene->flexed.surface.face_count;
    scene->body.faces = calloc(scene->body.face_count, sizeof *scene->body.faces);
    assert_non_null(scene->body.faces);
    memcpy(scene->body.centre, scene->solved.bulk.centre, sizeof scene->body.centre);
    scene->material = METAL;
    scene->body.materials = &scene->material;
    scene->body.material_count = 1;
    scene->task = (struct sites_task){.body = *body, .most = 300, .between = true};
}

static void scene_make(struct scene *scene)
{
    const double size[2] = {RADIUS, 3.0 * RADIUS};
    const size_t cells[3] = {2, 2, 8};
    struct solid_mesh mesh;
    solid_shape_cylinder(ELEMENT_HEX27, size, cells, &METAL, &mesh);
    /* of two equal parts, whose border nothing is to be felt of */
    mesh.part_count = 2;
    mesh.part = realloc(mesh.part, 2 * sizeof *mesh.part);
    assert_non_null(mesh.part);
    mesh.part[1] = mesh.part[0];
    for (size_t e = 0; e < mesh.element_count; e++)
        mesh.parts[e] = mesh.points[mesh.nodes[mesh.first[e] + 6]][0] < 0.51 * size[1];
    scene_prepare(scene, &mesh);
}

static void plate(const double cube[3], double point[3])
{
    const double size[3] = {64e-3, 48e-3, 6e-3};
    for (int k = 0; k < 3; k++)
        point[k] = size[k] * cube[k];
}

static void sheet(const double cube[3], double point[3])
{
    plate(cube, point);
    point[2] *= 0.25;
}

/* of one element of 8 mm through its thickness */
static void scene_make_plate(struct scene *scene,
                             void (*map)(const double cube[3], double point[3]))
{
    struct block block = {ELEMENT_TET10, {8, 6, 1}, map, false};
    struct solid_mesh mesh = block_make(&block);
    mesh.part[0].material = METAL;
    scene_prepare(scene, &mesh);
}

static void sites_free(struct mesh_body *body)
{
    free(body->site_face);
    free(body->site_point);
    free(body->site_normal);
    free(body->between);
}

static void scene_free(struct scene *scene)
{
    free(scene->body.faces);
    sites_free(&scene->body);
    solved_free(&scene->solved);
    flexed_free(&scene->flexed);
}

/* the flexibility that is solved for without as many modes as the body's is */
static void remove_as_many(struct scene *scene)
{
    flexibility_free(scene->flexed.flexibility);
    scene->flexed.body.removed = scene->body.removed;
    scene->flexed.flexibility = flexibility_make(&scene->flexed.body);
    assert_non_null(scene->flexed.flexibility);
}

/* what the body's face says at a place, and what is solved for there; times E R */
static double told(const struct scene *scene, const struct flexibility_place *place)
{
    const struct mesh_body_face *face = &scene->body.faces[place->face];
    int count = scene->flexed.surface.faces[place->face].count;
    double shape[FACE_MOST_NODES], sum = 0.0;
    facet_shape(count, place->u, place->v, shape, NULL, NULL);
    for (int n = 0; n < count; n++)
        sum += shape[n] * face->flexibility[n];
    return sum * YOUNG * RADIUS;
}

static double solved_there(struct scene *scene, const struct flexibility_place *place)
{
    bool on_end = fabs(place->load.inward[0]) > 0.5;
    double curvature = on_end ? 0.0 : 0.5 / RADIUS;
    struct flexibility_answer answer = flexed_solve(&scene->flexed, place);
    return (answer.value + flexibility_of_contact(YOUNG, POISSON, curvature) +
            flexibility_slope(YOUNG, POISSON, curvature) * log(answer.radius / scene->body.cut)) *
           YOUNG * RADIUS;
}

/* The largest difference of what the body's face says at a place between directions, without that
 * along the normal, from what is solved for there; times E R. */
static double tensor_off(struct scene *scene, const struct flexibility_place *place)
{
    const struct mesh_body_face *face = &scene->body.faces[place->face];
    int count = scene->flexed.surface.faces[place->face].count;
    bool on_end = fabs(place->load.inward[0]) > 0.5;
    double shape[FACE_MOST_NODES], told[6] = {0.0}, curvature[9] = {0.0}, largest = 0.0;
    struct flexibility_place all = *place;
    all.loads = FLEXIBILITY_LOADS;
    struct flexibility_answer answer = flexed_solve(&scene->flexed, &all);
    /* a cylinder's */
    const double *n = place->load.inward;
    const double about[3] = {0.0, -n[2], n[1]};
    for (int k = 0; k < 9 && !on_end; k++)
        curvature[k] = about[k / 3] * about[k % 3] / RADIUS;
    cerruti3_add_slope(YOUNG, POISSON, n, curvature, log(answer.radius / scene->body.cut),
                       answer.tensor);
    cerruti3_add_contact(YOUNG, POISSON, n, curvature, answer.tensor);
    facet_shape(count, place->u, place->v, shape, NULL, NULL);
    for (int k = 0; k < 6; k++)
        for (int i = 0; i < count; i++)
            told[k] += shape[i] * (double)face->tensor[i][k];
    mesh_body_set_normal(n, 0.0, told);
    mesh_body_set_normal(n, 0.0, answer.tensor);
    for (int k = 0; k < 6; k++)
        largest = fmax(largest, fabs(told[k] - answer.tensor[k]));
    return largest * YOUNG * RADIUS;
}

/* Elements are 3.75 mm. Farther than one of them from the sharp edges what faces say is the
 * solution to .02/(E R), which moves the restitution of a beam by .004 in the median; nearer
 * to .02/(E distance), where an edge is worth .27, and nearer than a third, where its own solution
 * is good to .05, to .1/(E distance). Between directions the logarithm of the curved side is twelve
 * times that of the normal, and elements catch it to .06, not .005; edges are worth up to twice as
 * much. */
static void faces_tell_what_is_solved_for(void **state)
{
    (void)state;
    struct scene scene;
    struct fault fault;
    scene_make(&scene);
    assert_int_equal(sites_find(&scene.task, &scene.body, &scene.report, &fault), PERCUSS_OK);
    assert_int_equal(scene.report.unknown, 0);
    assert_true(scene.report.imbalance < 1e-6);
    assert_true(scene.report.usual_error * YOUNG * RADIUS < 0.02);
    assert_true(scene.body.removed <= 24);
    remove_as_many(&scene);

    size_t faces = scene.body.face_count;
    for (size_t i = 0; i < 36; i++) {
        double u = -0.8 + 0.5 * (double)(i % 3), v = -0.6 + 0.4 * (double)(i % 4);
        struct flexibility_place place = flexibility_place_make(
            flexibility_rule(scene.flexed.flexibility), flexibility_edges(scene.flexed.flexibility),
            i * 7919 % faces, u, v);
        double edge = place.edge / scene.flexed.surface.size;
        if (edge < 0.1)
            continue;
        double expected = solved_there(&scene, &place);
        double allowed = edge < 0.3   ? 0.1 * RADIUS / place.edge
                         : edge < 1.0 ? 0.02 * RADIUS / place.edge
                                      : 0.02;
        measured(edge < 1.0 ? "near an edge" : "far from edges", told(&scene, &place), expected,
                 allowed);
        measured(edge < 1.0 ? "near an edge, along" : "far from edges, along",
                 tensor_off(&scene, &place), 0.0,
                 edge < 0.3   ? 0.15 * RADIUS / place.edge
                 : edge < 1.0 ? 0.04 * RADIUS / place.edge
                              : 0.08);
    }

    /* both parts' faces say the same where they meet */
    const struct surface_face *all = scene.flexed.surface.faces;
    for (size_t f = 0; f < faces; f++)
        for (size_t g = 0; g < f; g++)
            for (size_t i = 0; i < 9 && all[f].patch == all[g].patch; i++)
                for (size_t j = 0; j < 9; j++)
                    if (all[f].nodes[i] == all[g].nodes[j])
                        assert_true(scene.body.faces[f].flexibility[i] ==
                                    scene.body.faces[g].flexibility[j]);

    /* the slope is that of the cylinder's curvature, to the fit's own percent, and none on an end
     */
    for (size_t f = 0; f < faces; f++) {
        double on_side = flexibility_slope(YOUNG, POISSON, 0.5 / RADIUS);
        double x = scene.flexed.mesh.points[scene.flexed.surface.faces[f].nodes[8]][0];
        bool on_end = x < 1e-9 || x > 3.0 * RADIUS - 1e-9;
        near_scaled(scene.body.faces[f].flexibility_slope[8], on_end ? 0.0 : on_side, on_side,
                    0.02);
    }
    scene_free(&scene);
}

/* A wall of one element: on its narrow sides every node is on an edge, and every place at most 3 mm
 * from one, and yet faces tell what is solved for to .2/(E distance), where an edge itself is worth
 * .27; before sites lay by how far a face reaches from its edge, they were off by up to 17. Within
 * an element of a corner, to .4. A site that was asked for is met wherever it is: quadratic faces
 * leave .05. Between directions edges are worth up to twice as much, and faces miss as much more.
 */
static void walls_of_one_element_are_known(void **state)
{
    (void)state;
    static const struct {
        double point[3], allowed;
    } PLACES[] = {
        {{26e-3, 0.0, 3e-3}, 0.2},   {{29e-3, 0.0, 1.2e-3}, 0.2}, {{41e-3, 0.0, 4.6e-3}, 0.2},
        {{11e-3, 0.0, 2e-3}, 0.2},   {{64e-3, 23e-3, 3e-3}, 0.2}, {{64e-3, 13e-3, 5e-3}, 0.2},
        {{33e-3, 21e-3, 6e-3}, 0.2}, {{33e-3, 7e-3, 6e-3}, 0.2},  {{33e-3, 2e-3, 6e-3}, 0.2},
        {{4e-3, 0.0, 3e-3}, 0.4},    {{2e-3, 3e-3, 6e-3}, 0.4},   {{50e-3, 1e-3, 6e-3}, 0.05},
        {{20e-3, 48e-3, 1e-3}, 0.05}};
    enum { ASKED = 2 }; /* the last ones */
    const size_t count = COUNT(PLACES);
    struct scene scene;
    struct fault fault;
    double asked[ASKED][3];
    for (size_t i = 0; i < ASKED; i++)
        memcpy(asked[i], PLACES[count - ASKED + i].point, sizeof asked[i]);
    scene_make_plate(&scene, plate);
    scene.task.exact_count = ASKED;
    scene.task.exact = (const double(*)[3])asked;
    scene.task.between = false;
    assert_int_equal(sites_find(&scene.task, &scene.body, &scene.report, &fault), PERCUSS_OK);
    assert_int_equal(scene.report.unknown, 0);
    assert_int_equal(scene.report.withdrawn, 0);
    assert_int_equal(scene.report.thin, 0);
    remove_as_many(&scene);
    for (size_t i = 0; i < count; i++) {
        const double *p = PLACES[i].point;
        struct flexibility_place place = flexed_place(&scene.flexed, p[0], p[1], p[2]);
        double length = fmin(place.edge, 6e-3) / RADIUS;
        measured("on a wall of one element, times E and the distance",
                 told(&scene, &place) * length, solved_there(&scene, &place) * length,
                 PLACES[i].allowed);
        measured("the same, along", tensor_off(&scene, &place) * length, 0.0,
                 2.0 * PLACES[i].allowed);
    }
    scene_free(&scene);
}

/* Of a wall that is a fifth of an element thick nothing is said, but on its narrow sides, whose
 * own wall is the whole plate. */
static void thin_walls_are_not_known(void **state)
{
    (void)state;
    struct scene scene;
    struct fault fault;
    scene_make_plate(&scene, sheet);
    scene.task.between = false;
    assert_int_equal(sites_find(&scene.task, &scene.body, &scene.report, &fault), PERCUSS_OK);
    near(scene.report.thinnest, 1.5e-3, 1e-9);
    assert_true(scene.report.thin > 0 && scene.report.thin <= scene.report.unknown);
    size_t wide = 0;
    for (size_t f = 0; f < scene.body.face_count; f++) {
        const double *area = flexibility_rule(scene.flexed.flexibility)
                                 ->areas[flexibility_rule(scene.flexed.flexibility)->first[f]];
        bool is_wide = fabs(area[2]) > 0.5 * norm3(area);
        wide += is_wide;
        for (size_t n = 0; n < scene.flexed.surface.faces[f].count; n++)
            assert_int_equal(isnan(scene.body.faces[f].flexibility[n]), is_wide);
    }
    assert_int_equal(scene.report.withdrawn, wide);
    scene_free(&scene);
}

/* What faces say against physics, or against what was solved for on them, is taken back. */
static void what_cannot_be_is_taken_back(void **state)
{
    (void)state;
    struct scene scene;
    struct site_field field;
    scene_make_plate(&scene, plate);
    const struct surface_rule *rule = flexibility_rule(scene.flexed.flexibility);
    struct flexibility_place at = flexed_place(&scene.flexed, 30e-3, 0.0, 2e-3);
    double unit = 1.0 / (YOUNG * 2e-3);
    /* a value that says nothing, one within the allowance, one beyond, and too negative a one */
    const double solved[4] = {NAN, 0.45 * unit, 0.55 * unit, NAN};
    const double said[4] = {0.0, 0.0, 0.0, -2.0 * unit};
    const size_t taken_back[4] = {0, 0, 1, 1};
    for (size_t i = 0; i < 4; i++) {
        for (size_t f = 0; f < scene.body.face_count; f++)
            for (int n = 0; n < FACE_MOST_NODES; n++)
                scene.body.faces[f].flexibility[n] = f == at.face ? said[i] : 0.0;
        assert_true(site_field_make(&field, rule, flexibility_edges(scene.flexed.flexibility), 1,
                                    &at, &solved[i], NULL, 8e-3));
        assert_int_equal(site_faces_check(&field, rule, &scene.body), taken_back[i]);
        assert_int_equal(isnan(scene.body.faces[at.face].flexibility[0]), taken_back[i] > 0);
        site_field_free(&field);
    }
    scene_free(&scene);
}

/* Two processes find what one does, to the rounding of sums whose order follows from where memory
 * lies. */
static void processes_share_the_sites(void **state)
{
    (void)state;
    enum { MOST = 40 };
    struct scene scene;
    struct fault fault;
    float alone[MOST * MOST];
    scene_make(&scene);
    scene.task.most = MOST;
    assert_int_equal(sites_find(&scene.task, &scene.body, &scene.report, &fault), PERCUSS_OK);
    assert_int_equal(scene.body.site_count, MOST);
    memcpy(alone, scene.body.between, sizeof alone);
    free(scene.body.site_face);
    free(scene.body.site_point);
    free(scene.body.site_normal);
    free(scene.body.between);
    scene.task.processes = 2;
    assert_int_equal(sites_find(&scene.task, &scene.body, &scene.report, &fault), PERCUSS_OK);
    assert_int_equal(scene.body.site_count, MOST);
    for (size_t i = 0; i < MOST * MOST; i++)
        near(scene.body.between[i] * YOUNG * RADIUS, alone[i] * YOUNG * RADIUS, 1e-6);
    assert_true(scene.report.imbalance < 1e-6);
    scene_free(&scene);
}

/* parts that copies of the process alone have done, or died of */
struct shares {
    pid_t own;
    bool deadly;
    int *by; /* [parts], shared: the process */
};

static enum percuss_status note_process(void *context, size_t part, struct fault *fault)
{
    const struct shares *shares = context;
    (void)fault;
    if (getpid() != shares->own && shares->deadly)
        raise(SIGKILL);
    /* time for the others */
    usleep(2000);
    shares->by[part] = getpid();
    return PERCUSS_OK;
}

/* Copies take parts; those that a killed one had begun are done all the same. */
static void killed_copies_lose_nothing(void **state)
{
    (void)state;
    enum { PARTS = 64 };
    struct fault fault;
    struct shares shares = {.own = getpid(), .by = forked_memory(PARTS * sizeof(int))};
    struct forked_work work = {
        .parts = PARTS, .processes = 3, .part = note_process, .context = &shares};
    assert_non_null(shares.by);
    for (int deadly = 0; deadly < 2; deadly++) {
        size_t own = 0, others = 0;
        shares.deadly = deadly;
        memset(shares.by, 0, PARTS * sizeof(int));
        assert_int_equal(forked_run(&work, &fault), PERCUSS_OK);
        for (size_t i = 0; i < PARTS; i++) {
            own += shares.by[i] == shares.own;
            others += shares.by[i] != shares.own && shares.by[i] != 0;
        }
        assert_int_equal(own + others, PARTS);
        assert_true(deadly ? others == 0 : others > 0);
    }
    forked_memory_free(shares.by, PARTS * sizeof(int));
}

static bool note_own_process(void *context)
{
    struct fault fault;
    return note_process(context, 0, &fault) == PERCUSS_OK;
}

/* A copy's work is waited for; that of a killed one is not done. */
static void a_copy_works_beside(void **state)
{
    (void)state;
    struct shares shares = {.own = getpid(), .by = forked_memory(sizeof(int))};
    assert_non_null(shares.by);
    pid_t copy = forked_begin(note_own_process, &shares);
    assert_true(forked_end(copy));
    assert_int_equal(*shares.by, copy);
    shares.deadly = true;
    assert_false(forked_end(forked_begin(note_own_process, &shares)));
    assert_false(forked_end(-1));
    forked_drop(-1);
    forked_memory_free(shares.by, sizeof(int));
}

/* Sites that were asked for are there, and between them stands what one does to the other. */
static void sites_know_each_other(void **state)
{
    (void)state;
    struct scene scene;
    struct fault fault;
    const double exact[2][3] = {{0.0, 0.0, 0.0}, {3.0 * RADIUS, 0.0, 0.4 * RADIUS}};
    scene_make(&scene);
    scene.task.exact_count = 2;
    scene.task.exact = exact;
    scene.task.most = 40;
    /* as many as were foretold without factor and modes */
    struct sites_sample sample;
    struct sites_task early = scene.task;
    early.body.factor = NULL;
    early.body.shapes = early.body.omega = NULL;
    assert_int_equal(sites_sample(&early, &sample, &fault), PERCUSS_OK);
    assert_int_equal(sample.count, 40);
    assert_true(sample.seconds > 0.0 && sample.seconds < 10.0);
    assert_int_equal(sites_find(&scene.task, &scene.body, &scene.report, &fault), PERCUSS_OK);
    assert_int_equal(scene.body.site_count, 40);
    for (size_t i = 0; i < 2; i++)
        for (size_t k = 0; k < 3; k++)
            near(scene.body.site_point[i][k] + scene.body.centre[k], exact[i][k], 1e-9);
    near(scene.body.site_normal[0][0], -1.0, 1e-9);

    remove_as_many(&scene);
    struct flexibility_place places[2] = {
        flexed_place(&scene.flexed, 0.0, 0.0, 0.0),
        flexed_place(&scene.flexed, 3.0 * RADIUS, 0.0, 0.4 * RADIUS)};
    double own = solved_there(&scene, &places[0]);
    double other = flexibility_response(scene.flexed.flexibility, 0, &places[1]);
    /* modes that were given back are the mesh's own: test_flexibility.c */
    near(scene.body.between[0] * YOUNG * RADIUS, own, 5e-4);
    near(scene.body.between[1] * YOUNG * RADIUS, other * YOUNG * RADIUS, 2e-3);
    assert_true(scene.body.between[1] == scene.body.between[scene.body.site_count]);
    assert_true(scene.report.asymmetry * YOUNG * RADIUS < 0.01);
    scene_free(&scene);
}

/* A body of the scene's mesh and modes whose sites are solved for later. */
static struct mesh_body *later_body(const struct scene *scene)
{
    struct fault fault;
    struct mesh_body *body;
    const struct reduced_parts parts = {.mesh = &scene->flexed.mesh,
                                        .surface = &scene->flexed.surface,
                                        .bulk = &scene->solved.bulk,
                                        .modes = &scene->solved.modes,
                                        .source = "",
                                        .supports = "",
                                        .mesh_path = "cylinder",
                                        .mesh_options = "unit=1"};
    assert_int_equal(reduced_body_make(&parts, &body, &fault), PERCUSS_OK);
    sites_leave(&scene->flexed.body, scene->body.removed, body);
    return body;
}

enum { ALONE = 3 };
/* On both ends and on the side of the cylinder, and too near to its edge. */
static const double asked_alone[ALONE + 1][3] = {{0.0, 0.0, 0.0},
                                                 {3.0 * RADIUS, 0.0, 0.4 * RADIUS},
                                                 {1.3 * RADIUS, 0.0, RADIUS},
                                                 {0.0, 0.0, 0.999 * RADIUS}};

/* With so many modes taken out. */
static void compare_alone(struct scene *scene, size_t modes, double allowed)
{
    struct fault fault;
    struct site_alone alone[ALONE + 1];
    struct sites_task task = scene->task;
    task.body.removed = modes;
    task.exact_count = ALONE;
    task.exact = asked_alone;
    task.most = 2 * ALONE;
    assert_int_equal(sites_find(&task, &scene->body, &scene->report, &fault), PERCUSS_OK);
    struct mesh_body *body = later_body(scene);
    task.body.removed = 0;
    task.body.shapes = task.body.omega = NULL;
    task.exact_count = ALONE + 1;
    task.between = false;
    assert_int_equal(sites_solve_alone(&task, body, alone, &fault), PERCUSS_OK);
    for (size_t i = 0; i < ALONE; i++) {
        assert_null(alone[i].unknown);
        near(alone[i].site.flexibility * YOUNG * RADIUS,
             scene->body.between[i * (scene->body.site_count + 1)] * YOUNG * RADIUS, allowed);
        /* where it was asked for, though it was solved for a little off the rim of a face */
        for (size_t k = 0; k < 3; k++)
            near(alone[i].site.point[k] + body->centre[k], asked_alone[i][k], 1e-9);
        assert_true(alone[i].aside <= scene->flexed.surface.size / 6.0);
    }
    near(alone[0].aside, 0.0, 1e-12);
    assert_string_equal(alone[ALONE].unknown, "the mesh is too coarse so near to an edge");
    assert_true(isnan(alone[ALONE].site.flexibility) && isnan(alone[ALONE].site.tensor[0]));
    /* between all directions, on the plane */
    remove_as_many(scene);
    struct flexibility_place place = flexed_place(&scene->flexed, 0.0, 0.0, 0.0);
    place.loads = FLEXIBILITY_LOADS;
    struct flexibility_answer answer = flexed_solve(&scene->flexed, &place);
    for (int k = 0; k < 6; k++)
        near(alone[0].site.tensor[k] * YOUNG * RADIUS, answer.tensor[k] * YOUNG * RADIUS, allowed);
    mesh_body_free(body);
}

/* A site by itself is the same site made ahead with all others. With no mode taken out nothing but
 * the order of the sums differs, and the single precision that those made ahead are kept in. Modes
 * are taken out before the solution or after it, which differs by how far the mesh's modes are off
 * those of the body, as where they are given back (sites_know_each_other): with elements half as
 * long it is 5e-4, with these 3e-3. */
static void sites_alone_are_those_made_ahead(void **state)
{
    (void)state;
    const double size[2] = {RADIUS, 3.0 * RADIUS};
    const size_t cells[3] = {1, 1, 4};
    struct scene scene;
    struct solid_mesh mesh;
    solid_shape_cylinder(ELEMENT_HEX27, size, cells, &METAL, &mesh);
    scene_prepare(&scene, &mesh);
    compare_alone(&scene, 0, 2e-6);
    sites_free(&scene.body);
    compare_alone(&scene, 8, 5e-3);
    scene_free(&scene);
}

static bool refuse(void *context, double done)
{
    (void)context;
    (void)done;
    return false;
}

static void a_watch_stops_it(void **state)
{
    (void)state;
    struct scene scene;
    struct fault fault;
    const struct watch watch = {refuse, NULL};
    scene_make(&scene);
    scene.task.watch = &watch;
    assert_int_equal(sites_find(&scene.task, &scene.body, &scene.report, &fault), PERCUSS_TIMEOUT);
    scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(faces_tell_what_is_solved_for),
        cmocka_unit_test(walls_of_one_element_are_known),
        cmocka_unit_test(thin_walls_are_not_known),
        cmocka_unit_test(what_cannot_be_is_taken_back),
        cmocka_unit_test(processes_share_the_sites),
        cmocka_unit_test(killed_copies_lose_nothing),
        cmocka_unit_test(a_copy_works_beside),
        cmocka_unit_test(sites_know_each_other),
        cmocka_unit_test(sites_alone_are_those_made_ahead),
        cmocka_unit_test(a_watch_stops_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
