/* The simple chain in Simbody: a slider for each car, Runge-Kutta-Merson with step control, the
 * couplers as a custom force whose permanent sets are committed after every step. */
#include "bench/chain.h"

#include <Simbody.h>

#include <algorithm>
#include <cstdio>
#include <string>

using namespace SimTK;

namespace {

/* Local error of a step that keeps forces and shortenings within 0.3 % of the reference; 1e-6
 * leaves 0.6 %, 1e-4 5 %. */
const double accuracy = 1e-7;

/* Couplers between neighbouring cars. */
class Couplers : public Force::Custom::Implementation {
  public:
    Couplers(const SimbodyMatterSubsystem &matter, int n) : matter(matter), n(n), set(n, 0.0) {
    }
    void begin(ChainResult *to) {
        result = to;
        std::fill(set.begin(), set.end(), 0.0);
    }
    double shortening(const State &state, int i) const {
        return matter.getMobilizedBody(MobilizedBodyIndex(i + 1)).getOneQ(state, 0) -
               matter.getMobilizedBody(MobilizedBodyIndex(i + 2)).getOneQ(state, 0);
    }
    void calcForce(const State &state, Vector_<SpatialVec> &, Vector_<Vec3> &,
                   Vector &mobility) const override {
        for (int i = 0; i < n - 1; i++) {
            const double force = chain_force(chain_coupler(n, i), shortening(state, i), set[i]);
            mobility[i] -= force;
            mobility[i + 1] += force;
        }
    }
    Real calcPotentialEnergy(const State &) const override {
        return 0.0;
    }
    bool dependsOnlyOnPositions() const override {
        return true;
    }
    /* After a step. */
    void commit(const State &state) {
        for (int i = 0; i < n - 1; i++) {
            const Coupler *coupler = chain_coupler(n, i);
            const double x = shortening(state, i);
            const double force = chain_force(coupler, x, set[i]);
            set[i] = chain_next_set(coupler, x, set[i], force);
            result->force[i] = std::max(result->force[i], force);
            result->shortening[i] = std::max(result->shortening[i], x);
        }
    }

  private:
    const SimbodyMatterSubsystem &matter;
    const int n;
    std::vector<double> set; /* [m] */
    ChainResult *result = nullptr;
};

class Simbody {
  public:
    explicit Simbody(int n)
        : matter(system), forces(system), couplers(new Couplers(matter, n)), n(n) {
        Force::Custom(forces, couplers); /* which owns it */
        const Body::Rigid body(MassProperties(CHAIN_MASS, Vec3(0), UnitInertia(1)));
        for (int i = 0; i < n; i++)
            MobilizedBody::Slider(matter.Ground(), body);
        start = system.realizeTopology();
        for (int i = 0; i < n / 2; i++)
            matter.getMobilizedBody(MobilizedBodyIndex(i + 1)).setOneU(start, 0, CHAIN_SPEED);
    }
    void run(ChainResult *result) {
        *result = ChainResult();
        couplers->begin(result);
        RungeKuttaMersonIntegrator integrator(system);
        integrator.setAccuracy(accuracy);
        integrator.setFinalTime(CHAIN_DURATION);
        integrator.setReturnEveryInternalStep(true);
        integrator.initialize(start);
        while (integrator.getTime() < CHAIN_DURATION) {
            integrator.stepTo(CHAIN_DURATION);
            couplers->commit(integrator.getState());
        }
        for (int i = 0; i < n; i++)
            result->speed[i] = matter.getMobilizedBody(MobilizedBodyIndex(i + 1))
                                   .getOneU(integrator.getState(), 0);
    }

  private:
    MultibodySystem system;
    SimbodyMatterSubsystem matter;
    GeneralForceSubsystem forces;
    Couplers *couplers;
    const int n;
    State start;
};

const char *version() {
    static std::string text;
    int major = 0, minor = 0, patch = 0;
    SimTK_version_simbody(&major, &minor, &patch);
    text = std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
    return text.c_str();
}

void *create(int n) {
    try {
        return new Simbody(n);
    } catch (const std::exception &failure) {
        std::fprintf(stderr, "bench: Simbody: %s\n", failure.what());
        return nullptr;
    }
}

void run(void *model, ChainResult *result) {
    static_cast<Simbody *>(model)->run(result);
}
void destroy(void *model) {
    delete static_cast<Simbody *>(model);
}

} // namespace

extern "C" const ChainPeer chain_simbody = {
    "Simbody", "Runge-Kutta-Merson, adaptive", version, create, run, destroy};
