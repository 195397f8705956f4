#include "validation/reference/Filtering.h"

#include <algorithm>
#include <cmath>

namespace tessera::reference {

namespace {

using scenes::Filter;

/// Clamp of texel coordinates: farther out neighbours are indistinguishable. It also keeps the indices in range.
constexpr double kFarthest = 1e15;

/// A coordinate on both axes of a level, in texels.
glm::dvec2 placeIn(const Pyramid& pyramid, int level, const glm::dvec2& texCoord) {
    return glm::clamp(texCoord * glm::dvec2(pyramid.sizeTexels(level)), -kFarthest, kFarthest);
}

glm::dvec4 wrappedTexel(const Pyramid& pyramid, int level, const scenes::Sampler& sampler, double column, double row) {
    const glm::ivec2 size = pyramid.sizeTexels(level);
    return pyramid.texel(level, wrapped(static_cast<long long>(column), size.x, sampler.wrapU),
                         wrapped(static_cast<long long>(row), size.y, sampler.wrapV));
}

glm::dvec4 nearest(const Pyramid& pyramid, int level, const scenes::Sampler& sampler, const glm::dvec2& texCoord) {
    const glm::dvec2 place = placeIn(pyramid, level, texCoord);
    return wrappedTexel(pyramid, level, sampler, std::floor(place.x), std::floor(place.y));
}

glm::dvec4 bilinear(const Pyramid& pyramid, int level, const scenes::Sampler& sampler, const glm::dvec2& texCoord) {
    const glm::dvec2 place = placeIn(pyramid, level, texCoord) - 0.5;
    const glm::dvec2 corner = glm::floor(place), weight = place - corner;
    const auto texel = [&](int column, int row) {
        return wrappedTexel(pyramid, level, sampler, corner.x + column, corner.y + row);
    };
    // a + (b - a) w: equal texels keep their value to the last bit, so that a normal of length zero stays zero.
    const auto between = [](const glm::dvec4& a, const glm::dvec4& b, double w) { return a + (b - a) * w; };
    return between(between(texel(0, 0), texel(1, 0), weight.x), between(texel(0, 1), texel(1, 1), weight.x), weight.y);
}

glm::dvec4 inLevel(const Pyramid& pyramid, int level, Filter filter, const scenes::Sampler& sampler,
                   const glm::dvec2& texCoord) {
    return usesNearest(filter) ? nearest(pyramid, level, sampler, texCoord)
                               : bilinear(pyramid, level, sampler, texCoord);
}

} // namespace

double levelOf(const Footprint& footprint, glm::ivec2 sizeTexels) {
    const glm::dvec2 size(sizeTexels);
    return std::log2(std::max(glm::length(footprint.dx * size), glm::length(footprint.dy * size)));
}

double finestLevelOf(const Footprint& footprint, glm::ivec2 sizeTexels) {
    const glm::dvec2 most = glm::max(glm::abs(footprint.dx), glm::abs(footprint.dy)) * glm::dvec2(sizeTexels);
    return std::log2(std::max(most.x, most.y));
}

double magnifiedUpTo(const scenes::Sampler& sampler) {
    const bool keepsSmooth = !usesNearest(sampler.magnification) && usesNearest(sampler.minification) &&
                             sampler.minification != Filter::Nearest;
    return keepsSmooth ? 0.5 : 0.0;
}

bool usesNearest(Filter filter) {
    return filter == Filter::Nearest || filter == Filter::NearestMipmapNearest || filter == Filter::NearestMipmapLinear;
}

glm::dvec4 filtered(const Pyramid& pyramid, const scenes::Sampler& sampler, const glm::dvec2& texCoord, double level,
                    double magnified) {
    const auto at = [&](int number, Filter filter) { return inLevel(pyramid, number, filter, sampler, texCoord); };
    if (!(level > magnified)) return at(0, sampler.magnification);
    const Filter filter = sampler.minification;
    const int smallest = pyramid.smallestLevel();
    const double held = std::clamp(level, 0.0, double(smallest));
    switch (filter) {
    case Filter::Nearest:
    case Filter::Linear:
        return at(0, filter);
    case Filter::NearestMipmapNearest:
    case Filter::LinearMipmapNearest:
        return at(std::clamp(int(std::ceil(held + 0.5)) - 1, 0, smallest), filter);
    case Filter::NearestMipmapLinear:
    case Filter::LinearMipmapLinear:
        break;
    }
    const double finer = std::floor(held), share = held - finer;
    const int coarser = std::min(int(finer) + 1, smallest);
    return (1.0 - share) * at(int(finer), filter) + share * at(coarser, filter);
}

} // namespace tessera::reference
