#include "renderer/frame/ShadowAtlas.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <queue>

#include "renderer/frame/FrameSettings.h"

namespace tessera::frame {

namespace {

/// The largest automatic side of a face; ShadowMapSettings::resolutionTexels may be larger.
constexpr int kMostFaceTexels = 2048;
/// The even bits of a Morton code, compacted.
int everyOtherBit(std::uint64_t bits) {
    int result = 0;
    for (int i = 0; i < 31; ++i) result |= int((bits >> (2 * i)) & 1u) << i;
    return result;
}

std::size_t bytesOf(const glm::ivec2& atlasTexels) {
    return std::size_t(atlasTexels.x) * std::size_t(atlasTexels.y) * kShadowTexelBytes;
}

glm::ivec2 atlasOf(std::uint64_t texels, int largestSide) {
    if (texels == 0) return {0, 0};
    const std::uint64_t block = std::uint64_t(largestSide) * std::uint64_t(largestSide);
    const std::uint64_t blocks = (texels + block - 1) / block;
    const auto mostInRow = std::uint64_t(kLargestSidePixels / largestSide);
    const std::uint64_t rows = (blocks + mostInRow - 1) / mostInRow;
    const std::uint64_t inRow = (blocks + rows - 1) / rows;
    // Clamped to fit an int; such an atlas exceeds any budget.
    const auto side = [&](std::uint64_t count) {
        return int(std::min(count * std::uint64_t(largestSide), std::uint64_t(1) << 30));
    };
    return {side(inRow), side(rows)};
}

} // namespace

int automaticSideTexels(double texels) {
    const double held = std::clamp(texels, double(kLeastFaceTexels), double(kMostFaceTexels));
    return int(std::bit_ceil(unsigned(std::ceil(held))));
}

std::vector<int> fitBudget(std::span<const ShadowDemand> lights, double budgetBytes) {
    std::vector<int> sidesTexels;
    for (const ShadowDemand& light : lights) sidesTexels.push_back(light.wantedTexels);
    struct Halving {
        double cost;
        std::size_t light;
        bool operator<(const Halving& other) const { // least cost on top; of equal ones the last
            return cost != other.cost ? cost > other.cost : light < other.light;
        }
    };
    std::uint64_t texels = 0;
    std::map<int, int> sides; // number of lights by side
    const auto count = [&](std::size_t i, int sign) {
        const auto side = std::uint64_t(sidesTexels[i]);
        texels += std::uint64_t(sign) * std::uint64_t(lights[i].faces) * side * side;
        if ((sides[sidesTexels[i]] += sign) == 0) sides.erase(sidesTexels[i]);
    };
    const auto change = [&](std::size_t i, int sideTexels) {
        count(i, -1);
        sidesTexels[i] = sideTexels;
        count(i, 1);
    };
    const auto fits = [&] {
        const glm::ivec2 atlas = atlasOf(texels, sides.empty() ? 1 : std::max(sides.rbegin()->first, 1));
        return double(bytesOf(atlas)) <= budgetBytes && atlas.y <= kLargestSidePixels;
    };
    std::priority_queue<Halving> halvings;
    const auto offer = [&](std::size_t i) {
        const double side = double(sidesTexels[i]);
        if (sidesTexels[i] <= kLeastFaceTexels) return;
        const double pixels = std::exp2(std::ceil(std::log2(std::max(lights[i].pixels, 1.0))));
        const double pixelsPerTexel = double(automaticSideTexels(lights[i].pictureTexels)) / side;
        halvings.push({pixels * pixelsPerTexel / (side * side * double(lights[i].faces)), i});
    };
    for (std::size_t i = 0; i < lights.size(); ++i) {
        count(i, 1);
        offer(i);
    }
    while (!halvings.empty() && !fits()) {
        const std::size_t i = halvings.top().light;
        halvings.pop();
        change(i, sidesTexels[i] / 2);
        offer(i);
    }
    for (std::size_t i = lights.size(); i-- > 0 && !fits();) change(i, 0);
    return sidesTexels;
}

glm::ivec2 placeFaces(std::span<const int> sidesTexels, std::vector<glm::ivec2>& cornersTexels) {
    cornersTexels.assign(sidesTexels.size(), glm::ivec2(0));
    // Squares of powers of two, the larger ones first, leave no gap along a Morton curve.
    std::vector<std::size_t> order(sidesTexels.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return sidesTexels[a] > sidesTexels[b]; });
    if (order.empty() || sidesTexels[order.front()] == 0) return {0, 0};
    const int largest = sidesTexels[order.front()];
    const std::uint64_t block = std::uint64_t(largest) * std::uint64_t(largest);
    std::uint64_t used = 0;
    for (const int side : sidesTexels) used += std::uint64_t(side) * std::uint64_t(side);
    const glm::ivec2 atlas = atlasOf(used, largest);
    const int inRow = atlas.x / largest;
    used = 0;
    for (const std::size_t i : order) {
        const auto side = std::uint64_t(sidesTexels[i]);
        const int number = int(used / block);
        const std::uint64_t within = used % block;
        cornersTexels[i] = glm::ivec2(number % inRow, number / inRow) * largest +
                           glm::ivec2(everyOtherBit(within), everyOtherBit(within >> 1));
        used += side * side;
    }
    return atlas;
}

} // namespace tessera::frame
