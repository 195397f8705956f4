#include <chrono>
#include <cstring>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "scenes/Deform.h"
#include "tests/support/Random.h"
#include "validation/timing/TimeSamples.h"

/// Cost of posing a vertex, relative to the machine's speed of copying its bytes.
namespace tessera::scenes {
namespace {

constexpr std::size_t kSkinnedVertices = 1'000'000, kInfluencesOfEach = 4, kJointsOfSkin = 64;

/// Positions and normals are read and written; a joint's number and weight are read for each influence.
constexpr std::size_t kBytesOfVertex = 2 * 2 * sizeof(glm::vec3) + kInfluencesOfEach * (sizeof(int) + sizeof(float));

template <typename Action>
double secondsTaken(const Action& action) {
    const auto start = std::chrono::steady_clock::now();
    action();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(SkinningSpeedSlow, aMillionVerticesOfFourJointsAreSkinnedAtAShareOfTheCopySpeed) {
    tessera::test::Random random(1);
    Shape shape;
    shape.influences = kInfluencesOfEach;
    for (std::size_t vertex = 0; vertex < kSkinnedVertices; ++vertex) {
        shape.rest.positionsOS.emplace_back(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
        shape.rest.normalsOS.emplace_back(0.0f, 0.0f, 1.0f);
        for (std::size_t i = 0; i < kInfluencesOfEach; ++i) {
            // Neighbouring joints of the skin, as in models.
            shape.joints.push_back(std::uint32_t((vertex * kJointsOfSkin / kSkinnedVertices + i) % kJointsOfSkin));
            shape.weights.push_back(float(random.between(0.1, 1.0)));
        }
    }
    std::vector<glm::dmat4x3> fromBind;
    for (std::size_t joint = 0; joint < kJointsOfSkin; ++joint)
        fromBind.emplace_back(glm::rotate(glm::dmat4(1.0), 0.1 * double(joint), glm::dvec3(0.0, 1.0, 0.0)));
    const VertexMatrices matrices{fromBind};
    Mesh mesh = shape.rest;

    // Larger than caches.
    std::vector<std::byte> from(std::size_t{128} << 20, std::byte{1}), to(from.size());
    std::vector<double> skinning, copying;
    for (int round = 0; round < 8; ++round) {
        const double skinned = secondsTaken([&] { deform(shape, {}, &matrices, mesh); });
        const double copied = secondsTaken([&] { std::memcpy(to.data(), from.data(), from.size()); });
        if (round == 0) continue; // pages are touched for the first time
        skinning.push_back(skinned);
        copying.push_back(copied);
    }
    EXPECT_EQ(to, from);
    EXPECT_NE(mesh.positionsOS.back(), shape.rest.positionsOS.back());
    const double seconds = validation::spreadOf(skinning).median;
    const double skinnedRate = 1e-9 * double(kBytesOfVertex * kSkinnedVertices) / seconds;
    const double copyRate = 1e-9 * 2.0 * double(from.size()) / validation::spreadOf(copying).median;
    fmt::print("skinning 10^6 vertices: {:.0f} ms, {:.2f} GB/s read and written; copies {:.1f} GB/s; share {:.3f}\n",
               1e3 * seconds, skinnedRate, copyRate, skinnedRate / copyRate);
#ifndef __SANITIZE_ADDRESS__
    // All cores deform vertices in double precision; one copies. Below this ratio most time is spent elsewhere.
    EXPECT_GT(skinnedRate / copyRate, 0.005);
#endif
}

} // namespace
} // namespace tessera::scenes
