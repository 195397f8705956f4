#include "validation/reference/Slots.h"

#include <algorithm>
#include <cmath>

#include "validation/reference/Filtering.h"
#include "validation/reference/LookupTolerance.h"

namespace tessera::reference {

namespace {

Footprint footprintOf(const scenes::TextureUse& use, const Hit& hit) {
    const std::vector<glm::vec2>& texCoords = hit.object->mesh->texCoords[std::size_t(use.texCoordSet)];
    if (texCoords.empty()) return {transformed(use.transform, glm::dvec2(0.0)), {}, {}};
    scenes::TextureTransform unmoved = use.transform;
    unmoved.offset = glm::vec2(0.0f);
    return {transformed(use.transform, hit.at<glm::dvec2>(texCoords)),
            transformed(unmoved, hit.weighted<glm::dvec2>(texCoords, hit.weightsDx)),
            transformed(unmoved, hit.weighted<glm::dvec2>(texCoords, hit.weightsDy))};
}

bool isUndecided(const scenes::Sampler& sampler, const Footprint& footprint, glm::ivec2 sizeTexels,
                 const LookupTolerance& tolerance) {
    const bool magnified = usesNearest(sampler.magnification), minified = usesNearest(sampler.minification);
    if (!magnified && !minified) return false;
    const double level = levelOf(footprint, sizeTexels), limit = magnifiedUpTo(sampler);
    if (magnified != minified && level > tolerance.magnifiedFrom - tolerance.coarser &&
        level <= limit + tolerance.finer)
        return true;
    if (!(level > limit ? minified : magnified)) return false;
    const glm::dvec2 place = footprint.texCoord * glm::dvec2(sizeTexels);
    const glm::dvec2 toEdge = glm::abs(place - glm::round(place));
    return glm::any(glm::lessThanEqual(toEdge, tolerance.texCoord * glm::dvec2(sizeTexels)));
}

/// Moves a texel's code values by `codes`, down or up.
glm::dvec4 recoded(const glm::dvec4& texel, const Pyramid& pyramid, const glm::ivec2& nudge, double codes) {
    if (nudge == glm::ivec2(0) || codes == 0.0) return texel;
    glm::dvec4 result;
    for (int c = 0; c < 4; ++c) {
        const bool isSrgb = pyramid.transfer() == Transfer::Srgb && c < 3;
        const double code = isSrgb ? srgbFromLinear(texel[c]) : texel[c];
        const double moved = std::clamp(code + nudge[c % 2] * codes, 0.0, 1.0);
        result[c] = isSrgb ? linearFromSrgb(moved) : moved;
    }
    return result;
}

} // namespace

glm::dvec4 texelOf(scenes::TextureSlot slot, const Hit& hit, const Textures& textures) {
    const scenes::TextureUse& use = hit.object->material->texture(slot);
    if (use.image == scenes::kNone) return glm::dvec4(1.0);
    const Pyramid& pyramid = textures.pyramid(use.image, transferOf(slot));
    const Footprint footprint = footprintOf(use, hit);
    const double level = levelOf(footprint, pyramid.sizeTexels(0));
    const double magnified = magnifiedUpTo(use.sampler);
    if (hit.nudge == Nudge()) return filtered(pyramid, use.sampler, footprint.texCoord, level, magnified);
    const LookupTolerance tolerance = lookupTolerance(textures.filtering(), use, footprint, pyramid, hit);
    const glm::dvec2 texCoord = footprint.texCoord + glm::dvec2(hit.nudge.texCoord) * tolerance.texCoord;
    // The middle level magnifies wherever it may, the end levels minify wherever they may.
    double nudged = level, upTo = magnified + tolerance.finer;
    if (hit.nudge.level != 0) {
        nudged += hit.nudge.level > 0 ? tolerance.coarser : -tolerance.finer;
        upTo = tolerance.magnifiedFrom - tolerance.coarser + (nudged - level);
    }
    return recoded(filtered(pyramid, use.sampler, texCoord, nudged, upTo), pyramid, hit.nudge.texel, tolerance.codes);
}

bool isUndecided(const Hit& hit, const Textures& textures) {
    for (std::size_t i = 0; i < scenes::kTextureSlotCount; ++i) {
        const scenes::TextureUse& use = hit.object->material->textures[i];
        if (use.image == scenes::kNone) continue;
        if (textures.filtering() == Filtering::Hardware) return true;
        const Pyramid& pyramid = textures.pyramid(use.image, transferOf(scenes::TextureSlot(i)));
        const Footprint footprint = footprintOf(use, hit);
        if (isUndecided(use.sampler, footprint, pyramid.sizeTexels(0),
                        lookupTolerance(textures.filtering(), use, footprint, pyramid, hit)))
            return true;
    }
    return false;
}

const std::vector<Nudge>& nudges() {
    static const std::vector<Nudge> all = [] {
        const glm::ivec2 corners[] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
        std::vector<Nudge> ends;
        for (const int level : {-1, 0, 1}) {
            for (const glm::ivec2& corner : corners) ends.push_back({corner, level, {}});
        }
        for (const int level : {-1, 0, 1}) {
            for (const glm::ivec2& corner : corners) ends.push_back({{}, level, corner});
        }
        for (const int level : {-1, 1}) ends.push_back({{}, level, {}});
        return ends;
    }();
    return all;
}

} // namespace tessera::reference
