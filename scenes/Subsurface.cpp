#include "scenes/Subsurface.h"

#include <cmath>

#include <fmt/format.h>

namespace tessera::scenes {

std::span<const NamedProfile> namedProfiles() {
    static const std::array<NamedProfile, 2> profiles{{
        // Source: d'Eon and Luebke 2007, "Advanced Techniques for Realistic Real-Time Skin Rendering", GPU Gems 3,
        // chapter 14.
        {"skin",
         {{0.0064f, {0.233f, 0.455f, 0.649f}},
          {0.0484f, {0.100f, 0.336f, 0.344f}},
          {0.187f, {0.118f, 0.198f, 0.0f}},
          {0.567f, {0.113f, 0.007f, 0.007f}},
          {1.99f, {0.358f, 0.004f, 0.0f}},
          {7.41f, {0.078f, 0.0f, 0.0f}}}},
        // From tools/fit_profile.py marble; with three digits it is within 2.8, 1.6 and 1.3 % of the dipole
        // (NamedProfiles.marbleIsNearTheDipole).
        {"marble",
         {{0.03f, {0.031f, 0.067f, 0.110f}},
          {0.126f, {0.199f, 0.229f, 0.236f}},
          {0.529f, {0.176f, 0.160f, 0.168f}},
          {2.22f, {0.205f, 0.244f, 0.264f}},
          {9.34f, {0.246f, 0.215f, 0.179f}},
          {39.2f, {0.143f, 0.085f, 0.043f}}}},
    }};
    return profiles;
}

const DiffusionProfile& profileOf(const Subsurface& subsurface) {
    return subsurface.profile.empty() ? namedProfiles().front().profile : subsurface.profile;
}

std::string profileProblem(const DiffusionProfile& profile) {
    if (profile.empty()) return "";
    if (profile.size() > kMostGaussians)
        return fmt::format("its profile has {} Gaussians; give 1 to {}", profile.size(), kMostGaussians);
    glm::dvec3 sum(0.0);
    for (const DiffusionGaussian& gaussian : profile) {
        const double variance = double(gaussian.varianceSquareMillimetres);
        if (!(variance >= 0.0 && variance <= kMostVariance))
            return fmt::format("a variance of its profile must be between 0 and {:g} square millimetres",
                               kMostVariance);
        for (int c = 0; c < 3; ++c)
            if (!(gaussian.weight[c] >= 0.0f && gaussian.weight[c] <= 1.0f))
                return "a weight of its profile must be between 0 and 1";
        sum += glm::dvec3(gaussian.weight);
    }
    for (int c = 0; c < 3; ++c)
        if (!(std::abs(sum[c] - 1.0) <= kProfileSumTolerance))
            return fmt::format("the weights of its profile sum to {:.4g}, {:.4g} and {:.4g} in red, green and blue; "
                               "divide them by their sums",
                               sum.r, sum.g, sum.b);
    return "";
}

} // namespace tessera::scenes
