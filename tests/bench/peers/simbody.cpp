// Copyright 2026 The percuss authors
// SPDX-License-Identifier: Apache-2.0
//
// An impact in Simbody: its Hunt and Crossley contact without dissipation, F = k d^1.5, between
// spheres on slides or a sphere and
//   bounce a half-space that stands still, onto which the sphere falls, with dissipation
//   balls  N spheres in a row
//   rod    sphere and the end of a chain of N masses, linear springs between them
//   beam   sphere and the middle of a chain of 2 N + 1 rigid pieces, pins with springs between
//   them: half of it, by symmetry
// reads: kind N integrator accuracy end; speed, mass and radius of a sphere, k; mass, spring and
// length of a piece; gravity, the height that it falls from, Simbody's dissipation      prints:
// seconds, the spheres' speeds at the end, and their places
#include <Simbody.h>

#include <cmath>
#include <ctime>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

using namespace SimTK;

namespace
{

struct Problem {
    std::string kind, integrator;
    int n;
    double accuracy, end, speed, mass, radius, k, piece_mass, spring, length, gravity, drop,
        dissipation;
};

struct Model {
    MultibodySystem system;
    SimbodyMatterSubsystem matter{system};
    GeneralForceSubsystem forces{system};
    GeneralContactSubsystem contacts{system};
    ContactSetIndex set = contacts.createContactSet();
    std::vector<MobilizedBody> spheres;
};

Body::Rigid body(double mass)
{
    return Body::Rigid(MassProperties(mass, Vec3(0), UnitInertia(1) * mass));
}

// Simbody: F = 4/3 sqrt(R) E d^1.5, R = R1 R2/(R1 + R2), E = E1 / 2^1.5 of surfaces with the same
// E1
double modulus(double k, double radius)
{
    return std::sqrt(8.0) * k / (4.0 / 3.0 * std::sqrt(radius));
}

void add_sphere(Model &model, const Problem &p, double scale, double place)
{
    MobilizedBody::Slider sphere(model.matter.Ground(), Transform(Vec3(place, 0, 0)),
                                 body(p.mass * scale), Transform());
    model.contacts.addBody(model.set, sphere, ContactGeometry::Sphere(p.radius), Transform());
    model.spheres.push_back(sphere);
}

void add_contact(Model &model, double stiffness, double dissipation = 0.0)
{
    HuntCrossleyForce contact(model.forces, model.contacts, model.set);
    for (int i = 0; i < model.contacts.getNumBodies(model.set); i++)
        contact.setBodyParameters(ContactSurfaceIndex(i), stiffness, dissipation, 0, 0, 0);
}

// half-space: x > 0 of its frame
void add_half_space(Model &model, const MobilizedBody &carrier)
{
    model.contacts.addBody(model.set, carrier, ContactGeometry::HalfSpace(), Transform());
}

void make_bounce(Model &model, const Problem &p)
{
    add_sphere(model, p, 1.0, -p.radius - p.drop);
    add_half_space(model, model.matter.Ground());
    Force::UniformGravity(model.forces, model.matter, Vec3(p.gravity, 0, 0));
    add_contact(model, modulus(p.k, p.radius), p.dissipation);
}

void make_balls(Model &model, const Problem &p)
{
    for (int i = 0; i < p.n; i++)
        add_sphere(model, p, 1.0, 2.0 * p.radius * i);
    add_contact(model, modulus(p.k, 0.5 * p.radius));
}

void make_rod(Model &model, const Problem &p)
{
    add_sphere(model, p, 1.0, -p.radius);
    MobilizedBody before;
    for (int i = 0; i <= p.n; i++) {
        double mass = p.piece_mass * (i == 0 || i == p.n ? 0.5 : 1.0);
        MobilizedBody::Slider piece(model.matter.Ground(), Transform(Vec3(p.length * i, 0, 0)),
                                    body(mass), Transform());
        if (i == 0)
            add_half_space(model, piece);
        else
            Force::TwoPointLinearSpring(model.forces, before, Vec3(0), piece, Vec3(0), p.spring,
                                        p.length);
        before = piece;
    }
    add_contact(model, modulus(p.k, p.radius));
}

// along y from the middle; the blow is along x
void make_beam(Model &model, const Problem &p)
{
    add_sphere(model, p, 0.5, -p.radius);
    MobilizedBody::Slider middle(model.matter.Ground(), Transform(), body(0.5 * p.piece_mass),
                                 Transform());
    add_half_space(model, middle);
    MobilizedBody before = middle;
    Vec3 half(0, 0.5 * p.length, 0);
    Body::Rigid rigid(
        MassProperties(p.piece_mass, Vec3(0), UnitInertia(square(p.length) / 12.0) * p.piece_mass));
    for (int i = 0; i < p.n; i++) {
        MobilizedBody::Pin piece(before, Transform(half), rigid, Transform(-half));
        Force::MobilityLinearSpring(model.forces, piece, MobilizerQIndex(0), p.spring, 0.0);
        before = piece;
    }
    add_contact(model, modulus(0.5 * p.k, p.radius));
}

std::unique_ptr<Integrator> integrator(const Problem &p, const System &system)
{
    if (p.integrator == "merson")
        return std::make_unique<RungeKuttaMersonIntegrator>(system);
    return std::make_unique<CPodesIntegrator>(system, CPodes::BDF);
}

} // namespace

int main()
try {
    Problem p;
    std::cin >> p.kind >> p.n >> p.integrator >> p.accuracy >> p.end >> p.speed >> p.mass >>
        p.radius >> p.k >> p.piece_mass >> p.spring >> p.length >> p.gravity >> p.drop >>
        p.dissipation;
    if (!std::cin) {
        std::cerr << "simbody: the problem is not complete\n";
        return 2;
    }
    Model model;
    (p.kind == "bounce"  ? make_bounce
     : p.kind == "balls" ? make_balls
     : p.kind == "rod"   ? make_rod
                         : make_beam)(model, p);
    State state = model.system.realizeTopology();
    model.spheres[0].setOneU(state, 0, p.speed);
    std::unique_ptr<Integrator> steps = integrator(p, model.system);
    steps->setAccuracy(p.accuracy);
    if (p.kind == "bounce")
        steps->setMaximumStepSize(1e-4); // a longer one may miss a contact
    std::clock_t began = std::clock();
    TimeStepper stepper(model.system, *steps);
    stepper.initialize(state);
    stepper.stepTo(p.end);
    std::cout.precision(15);
    std::cout << double(std::clock() - began) / CLOCKS_PER_SEC;
    for (const MobilizedBody &sphere : model.spheres)
        std::cout << ' ' << sphere.getOneU(stepper.getState(), 0);
    for (const MobilizedBody &sphere : model.spheres)
        std::cout << ' ' << sphere.getOneQ(stepper.getState(), 0);
    std::cout << '\n';
} catch (const std::exception &why) {
    std::cerr << why.what() << '\n';
    return 1;
}
