/* Copyright 2026 The percuss authors
 * SPDX-License-Identifier: Apache-2.0 */

#include "engine_text.h"

#include <math.h>
#include <string.h>

/* solref in its direct form is stiffness and damping of a unit mass, so that all bodies bounce
 * alike; solimp is constant: the constraint's own softness then drops out of both. */
static void print_mujoco(FILE *file, const struct engine_case *engine_case,
                         const struct engine_fit *fit)
{
    (void)engine_case;
    fprintf(
        file,
        "<option timestep=\"%.6g\"/>\n"
        "<contact>\n"
        "  <pair geom1=\"A\" geom2=\"B\" condim=\"1\" solref=\"%.8g %.8g\" solimp=\"0.9 0.9 1\"/>\n"
        "</contact>\n",
        fit->step, -fit->stiffness / fit->mass, -fit->damping / fit->mass);
}

static void print_bullet(FILE *file, const struct engine_case *engine_case,
                         const struct engine_fit *fit)
{
    fprintf(file,
            "p.changeDynamics(A, -1, restitution=%.6g)\n"
            "p.changeDynamics(B, -1, restitution=1.0)  # a pair has the product of both\n"
            "p.setPhysicsEngineParameter(restitutionVelocityThreshold=%.4g)\n",
            fit->restitution, 0.5 * engine_case->points[0].speed);
}

/* gn is multiplied there by the mass m1 m2 / (m1 + m2) of the bodies, wherever they touch; that is
 * the effective mass of a blow through both centres. */
static void print_chrono(FILE *file, const struct engine_case *engine_case,
                         const struct engine_fit *fit)
{
    (void)engine_case;
    fprintf(file,
            "// of both bodies alike\n"
            "auto rigid = chrono_types::make_shared<ChContactMaterialNSC>();\n"
            "rigid->SetRestitution(%.6gf);\n"
            "// or, by forces, at steps of at most %.3g s\n"
            "system.UseMaterialProperties(false);\n"
            "system.SetContactForceModel(ChSystemSMC::Hooke);\n"
            "auto smooth = chrono_types::make_shared<ChContactMaterialSMC>();\n"
            "smooth->SetKn(%.8gf);  // N/m\n"
            "smooth->SetGn(%.8gf);  // 1/s, for bodies with m1 m2 / (m1 + m2) = %.6g kg\n",
            fit->restitution, fit->step, fit->stiffness, fit->damping / fit->mass, fit->mass);
}

/* Stiffnesses in series: each body has twice that of the pair, and then the pair has the bodies'
 * dissipation. */
static void print_drake(FILE *file, const struct engine_case *engine_case,
                        const struct engine_fit *fit)
{
    (void)engine_case;
    fprintf(file,
            "// of both bodies alike; steps of at most %.3g s\n"
            "geometry::ProximityProperties properties;\n"
            "geometry::AddContactMaterial(%.8g /* s/m */, %.8g /* N/m */,\n"
            "                             multibody::CoulombFriction<double>(0.0, 0.0), "
            "&properties);\n",
            fit->step, fit->dissipation, 2.0 * fit->stiffness);
}

/* Its hooke takes the restitution, and makes the damping of it. */
static void print_dem(FILE *file, const struct engine_case *engine_case,
                      const struct engine_fit *fit)
{
    (void)engine_case;
    fprintf(file,
            "pair_style granular\n"
            "pair_coeff * * hooke %.8g %.6g tangential linear_nohistory 0.0 0.0 damping "
            "coeff_restitution\n"
            "timestep %.4g\n",
            fit->stiffness, fit->restitution, fit->step);
}

/* A node of area 1: pressures are forces. */
static void print_abaqus(FILE *file, const struct engine_case *engine_case,
                         const struct engine_fit *fit)
{
    (void)engine_case;
    fprintf(file,
            "*SURFACE INTERACTION, NAME=IMPACT\n"
            "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"
            "%.8g,\n"
            "*CONTACT DAMPING, DEFINITION=DAMPING COEFFICIENT\n"
            "%.8g,\n",
            fit->stiffness, fit->damping);
}

static const char A_SPRING[] = "a spring with a damper: one restitution at all speeds";
static const struct engine engines[ENGINE_COUNT] = {
    {"mujoco", ENGINE_CONSTANT, "<!--", " -->", A_SPRING, print_mujoco},
    {"bullet", ENGINE_CONSTANT, "#", "", "Newton's restitution, one at all speeds", print_bullet},
    {"chrono", ENGINE_CONSTANT, "//", "", A_SPRING, print_chrono},
    {"drake", ENGINE_HUNT_CROSSLEY, "//", "",
     "a spring with Hunt and Crossley's damper: a restitution that falls with the speed",
     print_drake},
    {"dem", ENGINE_CONSTANT, "#", "", "LAMMPS's granular hooke: one restitution at all speeds",
     print_dem},
    {"abaqus", ENGINE_CONSTANT, "**", "",
     "a spring with a damper between rigid bodies, the touching node of area 1: one restitution "
     "at all speeds",
     print_abaqus},
};

const struct engine *engine_find(const char *name)
{
    for (unsigned i = 0; i < ENGINE_COUNT; i++)
        if (!strcmp(engines[i].name, name))
            return &engines[i];
    return NULL;
}

const char *engine_name(unsigned i)
{
    return engines[i].name;
}

/* A line of the comment. */
#define COMMENT(file, engine, format, ...)                                                         \
    fprintf(file, "%s " format "%s\n", (engine)->comment, __VA_ARGS__, (engine)->comment_end)

static void print_points(FILE *file, const struct engine *engine,
                         const struct engine_case *engine_case)
{
    COMMENT(file, engine, "%12s %11s %9s %12s %11s", "speed m/s", "restitution", "+-", engine->name,
            "contact s");
    for (size_t i = 0; i < engine_case->count; i++) {
        const struct engine_point *point = &engine_case->points[i];
        COMMENT(file, engine, "%12.4g %11.4f %9.2g %12.4f %11.3g", point->speed, point->restitution,
                point->error, point->model, point->duration);
    }
}

/* Without two hyphens in a row, which end a comment of XML. */
static void print_title(FILE *file, const struct engine *engine,
                        const struct engine_case *engine_case)
{
    fprintf(file, "%s percuss %s: ", engine->comment, engine_case->version);
    for (const char *c = engine_case->title; *c; c++) {
        fputc(*c, file);
        if (c[0] == '-' && c[1] == '-')
            fputc(' ', file);
    }
    fprintf(file, "%s\n", engine->comment_end);
}

void engine_print(FILE *file, const struct engine *engine, const struct engine_case *engine_case,
                  const struct engine_fit *fit)
{
    print_title(file, engine, engine_case);
    COMMENT(file, engine, "for %s: %s", engine->name, engine->model);
    print_points(file, engine, engine_case);
    COMMENT(file, engine,
            "its restitution is at most %.2g off percuss's at these speeds; without friction",
            fit->worst);
    if (engine_case->step > 0.0 && fit->duration <= ENGINE_STEPS * engine_case->step)
        COMMENT(file, engine,
                "the contact is softer than it is, %.3g s, for %d steps of %.3g s in it",
                fit->duration, ENGINE_STEPS, engine_case->step);
    engine->print(file, engine_case, fit);
}
