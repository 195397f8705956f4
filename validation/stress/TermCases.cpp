// The microfacet terms alone, against double precision at the same single-precision arguments.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "validation/reference/Microfacet.h"
#include "validation/stress/StressCase.h"
#include "validation/stress/StressRandom.h"

namespace tessera::validation {

namespace {

std::size_t samplesOf(const StressBench& bench) {
    return bench.effort() == StressEffort::Full ? 1u << 20 : 1u << 15;
}

/// D from the cross product, which in double keeps every digit of the given n and h, normalised or not.
double distributionOf(double alpha, const glm::dvec3& n, const glm::dvec3& h) {
    const double cosine = glm::dot(n, h);
    if (!(cosine > 0.0)) return 0.0;
    const glm::dvec3 across = glm::cross(n, h);
    const double spread = alpha * alpha * cosine * cosine + glm::dot(across, across);
    return alpha * alpha / (std::numbers::pi * spread * spread);
}

/// Half vectors from the peak to far outside the lobe.
void measureDistribution(StressBench& bench, float alpha, StressFigures& figures) {
    StressRandom random(1);
    const std::size_t count = samplesOf(bench);
    std::vector<glm::vec4> inputs;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 n(random.direction());
        const double angle = std::atan(double(alpha) * std::tan(0.49 * std::numbers::pi * random.unit()));
        const glm::vec3 h(random.around(glm::normalize(glm::dvec3(n)), std::cos(angle)));
        // The peak itself, and half vectors below the horizon, where D is exactly 0.
        const glm::vec3 placed = i % 64 == 0 ? n : i % 64 == 1 ? -h : h;
        inputs.insert(inputs.end(), {{n, alpha}, {placed, 1.0f}, {1.0f, 1.5f, 1.0f, 0.0f}});
    }
    const std::vector<glm::vec4> out = bench.run("stress/terms.comp", {}, inputs, count, 2);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 n(inputs[3 * i]), h(inputs[3 * i + 1]);
        const double truth = distributionOf(double(alpha), n, h);
        figures.count({&out[2 * i].x, 1});
        const double shown = double(out[2 * i].x);
        figures.error(truth == 0.0 ? std::abs(shown) : std::abs(shown / truth - 1.0),
                      [&] { return fmt::format("alpha {:g}, |n x h| {:.3g}", alpha, glm::length(glm::cross(n, h))); });
    }
}

/// Masking at cosines down to 1e-8 and every alpha; V = G / (4 n.l n.v).
void measureMasking(StressBench& bench, StressFigures& figures) {
    StressRandom random(2);
    const std::size_t count = samplesOf(bench);
    std::vector<glm::vec4> inputs;
    for (std::size_t i = 0; i < count; ++i) {
        const auto alpha = float(random.logarithmic(1e-3, 1.0));
        const auto light = float(random.logarithmic(1e-8, 1.0)), view = float(random.logarithmic(1e-8, 1.0));
        inputs.insert(inputs.end(), {{0.0f, 0.0f, 1.0f, alpha}, {0.0f, 0.0f, 1.0f, light}, {view, 1.5f, 1.0f, 0.0f}});
    }
    const std::vector<glm::vec4> out = bench.run("stress/terms.comp", {}, inputs, count, 2);
    for (std::size_t i = 0; i < count; ++i) {
        const double alpha = double(inputs[3 * i].w), light = double(inputs[3 * i + 1].w),
                     view = double(inputs[3 * i + 2].x), four = 4.0 * light * view;
        const double separable = reference::maskingSmith(alpha, light) * reference::maskingSmith(alpha, view) / four;
        const double correlated = reference::maskingCorrelated(alpha, light, view) / four;
        figures.count({&out[2 * i].y, 2});
        const double rel = std::max(std::abs(double(out[2 * i].y) / separable - 1.0),
                                    std::abs(double(out[2 * i].z) / correlated - 1.0));
        figures.error(rel, [&] { return fmt::format("alpha {:.3g}, n.l {:.3g}, n.v {:.3g}", alpha, light, view); });
    }
}

struct Interface {
    float ior, cosine;
};

void measureFresnel(StressBench& bench, const std::vector<Interface>& interfaces, StressFigures& figures) {
    std::vector<glm::vec4> inputs;
    for (const Interface& at : interfaces)
        inputs.insert(inputs.end(), {{0, 0, 1, 1}, {0, 0, 1, 1}, {1.0f, at.ior, at.cosine, 0.04f}});
    const std::vector<glm::vec4> out = bench.run("stress/terms.comp", {}, inputs, interfaces.size(), 2);
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
        const double ior = double(interfaces[i].ior), cosine = double(interfaces[i].cosine);
        const double truth = reference::fresnelDielectric(ior, cosine), shown = double(out[2 * i].w);
        figures.count({&out[2 * i].w, 1});
        // Where the truth is exactly 0, at an index of 1, any other value is wrong.
        const double rel = truth == 0.0 ? std::abs(shown) : std::abs(shown / truth - 1.0);
        figures.error(rel, [&] { return fmt::format("ior {:.9g}, cosine {:.3g}", ior, cosine); });
    }
}

void measureDenserMedia(StressBench& bench, StressFigures& figures) {
    StressRandom random(3);
    std::vector<Interface> interfaces;
    for (std::size_t i = 0; i < samplesOf(bench); ++i) {
        const double away = random.logarithmic(1e-6, 999.0);
        const auto ior = float(i % 64 == 0 ? 1.0 : 1.0 + away);
        interfaces.push_back({ior, float(random.logarithmic(1e-4, 1.0))});
    }
    measureFresnel(bench, interfaces, figures);
}

void measureThinnerMedia(StressBench& bench, StressFigures& figures) {
    StressRandom random(4);
    std::vector<Interface> interfaces;
    for (std::size_t i = 0; i < samplesOf(bench); ++i) {
        const auto ior = float(random.between(0.2, 0.999));
        const double critical = std::sqrt(1.0 - double(ior) * double(ior));
        const double cosine = i % 2 == 0 ? critical + random.between(-5e-5, 5e-5) : random.between(1e-3, 1.0);
        interfaces.push_back({ior, float(std::clamp(cosine, 1e-3, 1.0))});
    }
    measureFresnel(bench, interfaces, figures);
}

} // namespace

void addTermCases(std::vector<StressCase>& cases) {
    struct Distribution {
        float alpha;
        double tolerance;
    };
    for (const Distribution& at : {Distribution{0.001f, 2e-4}, {0.002f, 1e-4}, {0.01f, 2e-5}, {0.3f, 2e-6}}) {
        cases.push_back(
            {fmt::format("terms/distribution_{:g}", at.alpha),
             fmt::format("D at alpha {:g}, at the same n and h", at.alpha), StressBound::WorstRel, at.tolerance,
             "n x h cancels to alpha, so fp32 keeps 6e-8/alpha of it, squared and squared again",
             [at](StressBench& bench, StressFigures& figures) { measureDistribution(bench, at.alpha, figures); }});
    }
    cases.push_back({"terms/masking", "G/(4 n.l n.v) in both forms, cosines from 1e-8 to 1", StressBound::WorstRel,
                     2e-6, "ten roundings of 6e-8 and no cancellation", measureMasking});
    cases.push_back({"terms/fresnel", "F for an index from 1 + 1e-6 to 1000, exactly 0 at 1", StressBound::WorstRel,
                     1e-5, "ten roundings of 6e-8, some squared", measureDenserMedia});
    cases.push_back({"terms/total_reflection", "F for an index from 0.2 to 1, to its critical angle and beyond",
                     StressBound::WorstRel, 1e-5,
                     "as for denser media: g^2 is taken with what its squares lose to rounding, so nothing cancels",
                     measureThinnerMedia});
}

} // namespace tessera::validation
