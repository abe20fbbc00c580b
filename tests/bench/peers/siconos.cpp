// Copyright 2026 The percuss authors
// SPDX-License-Identifier: Apache-2.0
//
// An impact in Siconos: M a + K q = H' f, the gaps -H q of contacts that touch at the start, by one
// of its laws:
//   newton  unilateral contacts with Newton's e, Moreau and Jean's time stepping
//   hertz   f = k (H q)^1.5 as internal forces, the same time stepping
//   lsodar  the same forces, its event-driven integrator LSODAR; 1/steps is the tolerance
//   liu     Liu, Zhao and Brogliato's impulses of compliant contacts in an instant; 1/steps is the
//   part of the impulse before
// reads: law steps end e; n m; M, K (diagonals), v; H (m rows); k       prints: seconds, the
// velocities at the end
#include <SiconosKernel.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

namespace
{

struct Problem {
    std::string law;
    unsigned steps, n, m;
    double end, restitution, k;
    std::vector<double> mass, stiffness, velocity, h; // h: m x n
};

Problem problem; // the forces' plugins have no other way to it

void read(std::vector<double> &values, size_t count)
{
    values.resize(count);
    for (double &value : values)
        std::cin >> value;
}

bool read_problem()
{
    Problem &p = problem;
    std::cin >> p.law >> p.steps >> p.end >> p.restitution >> p.n >> p.m;
    read(p.mass, p.n);
    read(p.stiffness, p.n);
    read(p.velocity, p.n);
    read(p.h, size_t(p.m) * p.n);
    std::cin >> p.k;
    return bool(std::cin);
}

double indentation(const double *row, const double *q)
{
    double d = 0.0;
    for (unsigned i = 0; i < problem.n; i++)
        d += row[i] * q[i];
    return d > 0.0 ? d : 0.0;
}

void forces(double, unsigned n, double *q, double *, double *f, unsigned, double *)
{
    for (unsigned i = 0; i < n; i++)
        f[i] = problem.stiffness[i] * q[i];
    for (unsigned c = 0; c < problem.m; c++) {
        const double *row = &problem.h[c * n];
        double d = indentation(row, q), force = problem.k * d * std::sqrt(d);
        for (unsigned i = 0; i < n; i++)
            f[i] += row[i] * force;
    }
}

void slopes(double, unsigned n, double *q, double *, double *j, unsigned, double *)
{
    std::fill(j, j + size_t(n) * n, 0.0);
    for (unsigned i = 0; i < n; i++)
        j[i * n + i] = problem.stiffness[i];
    for (unsigned c = 0; c < problem.m; c++) {
        const double *row = &problem.h[c * n];
        double slope = 1.5 * problem.k * std::sqrt(indentation(row, q));
        for (unsigned a = 0; a < n; a++)
            for (unsigned b = 0; b < n; b++)
                j[a * n + b] += slope * row[a] * row[b];
    }
}

SP::SimpleMatrix diagonal(const std::vector<double> &values)
{
    SP::SimpleMatrix matrix(new SimpleMatrix(values.size(), values.size()));
    for (size_t i = 0; i < values.size(); i++)
        (*matrix)(i, i) = values[i];
    return matrix;
}

SP::LagrangianDS bodies()
{
    SP::SiconosVector q(new SiconosVector(problem.n)), v(new SiconosVector(problem.velocity));
    if (problem.law == "newton" || problem.law == "liu") {
        SP::LagrangianLinearTIDS ds(new LagrangianLinearTIDS(q, v, diagonal(problem.mass)));
        ds->setKPtr(diagonal(problem.stiffness));
        return ds;
    }
    SP::LagrangianDS ds(new LagrangianDS(q, v, diagonal(problem.mass)));
    ds->setComputeFIntFunction(forces);
    ds->setComputeJacobianFIntqFunction(slopes);
    return ds;
}

void link_contacts(const SP::NonSmoothDynamicalSystem &system, const SP::LagrangianDS &ds)
{
    for (unsigned c = 0; c < problem.m; c++) {
        SP::SimpleMatrix h(new SimpleMatrix(1, problem.n));
        for (unsigned i = 0; i < problem.n; i++)
            (*h)(0, i) = -problem.h[c * problem.n + i];
        SP::NonSmoothLaw law;
        if (problem.law == "liu")
            law.reset(new MultipleImpactNSL(problem.restitution, problem.k, 1.5));
        else
            law.reset(new NewtonImpactNSL(problem.restitution));
        SP::Relation relation(new LagrangianLinearTIR(h));
        system->link(SP::Interaction(new Interaction(law, relation)), ds);
    }
}

void step_through(const SP::NonSmoothDynamicalSystem &system, const SP::LagrangianDS &ds)
{
    SP::TimeDiscretisation times(new TimeDiscretisation(0.0, problem.end / problem.steps));
    SP::OneStepIntegrator integrator(new MoreauJeanOSI(0.5));
    SP::OneStepNSProblem lcp(new LCP());
    if (problem.law == "newton")
        link_contacts(system, ds);
    SP::TimeStepping simulation(new TimeStepping(system, times, integrator, lcp));
    simulation->setNewtonTolerance(1e-9);
    simulation->setNewtonMaxIteration(20);
    while (simulation->hasNextEvent()) {
        simulation->computeOneStep();
        simulation->nextStep();
    }
}

void follow_events(const SP::NonSmoothDynamicalSystem &system, const SP::LagrangianDS &ds)
{
    SP::TimeDiscretisation times(new TimeDiscretisation(0.0, problem.end));
    std::shared_ptr<LsodarOSI> integrator(new LsodarOSI());
    SA::doublereal relative(new doublereal[1]), absolute(new doublereal[1]);
    relative[0] = 1.0 / problem.steps;
    absolute[0] = 1e-6 * relative[0];
    integrator->setTol(1, relative, absolute);
    std::shared_ptr<EventDriven> simulation(new EventDriven(system, times));
    simulation->insertIntegrator(integrator);
    SP::OneStepNSProblem impact(new LCP());
    if (problem.law == "liu") {
        link_contacts(system, ds);
        double impulse = problem.mass[0] * problem.velocity[0] / problem.steps;
        std::shared_ptr<MultipleImpact> steps(new MultipleImpact("BiStiffness", impulse));
        steps->SetNstepMax(10000000);
        impact = steps;
    }
    simulation->insertNonSmoothProblem(impact, SICONOS_OSNSP_ED_IMPACT);
    simulation->insertNonSmoothProblem(SP::OneStepNSProblem(new LCP()),
                                       SICONOS_OSNSP_ED_SMOOTH_ACC);
    simulation->initialize();
    integrator->setMaxNstep(1000000);
    while (simulation->hasNextEvent()) {
        simulation->advanceToEvent();
        simulation->processEvents();
    }
}

} // namespace

int main()
try {
    if (!read_problem()) {
        std::cerr << "siconos: the problem is not complete\n";
        return 2;
    }
    SP::NonSmoothDynamicalSystem system(
        new NonSmoothDynamicalSystem(0.0, problem.end * (1.0 + 1e-9)));
    SP::LagrangianDS ds = bodies();
    system->insertDynamicalSystem(ds);
    std::clock_t began = std::clock();
    if (problem.law == "newton" || problem.law == "hertz")
        step_through(system, ds);
    else
        follow_events(system, ds);
    std::cout.precision(15);
    std::cout << double(std::clock() - began) / CLOCKS_PER_SEC;
    for (unsigned i = 0; i < problem.n; i++)
        std::cout << ' ' << (*ds->velocity())(i);
    std::cout << '\n';
} catch (...) {
    Siconos::exception::process();
    return 1;
}
