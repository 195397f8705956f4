#include "viewer/session/Inspection.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "viewer/edit/Brightness.h"
#include "viewer/edit/NumberText.h"
#include "viewer/edit/Pick.h"

namespace tessera::viewer {
namespace {

std::string numbers(const glm::dvec3& values) {
    const auto text = [&](int component) { return numberText("%.4g", values[component]); };
    return fmt::format("{} {} {}", text(0), text(1), text(2));
}

std::string visits(std::size_t lights) {
    return fmt::format("visits {} light{}", lights, lights == 1 ? "" : "s");
}

void addSide(std::vector<std::string>& lines, const InspectedSide& side) {
    const frame::DebugViewInfo& view = frame::debugViewInfo(side.view);
    if (view.mapping == frame::DisplayMapping::Count)
        lines.push_back(fmt::format("{} {:.4g}", view.name, side.radiance.x));
    else
        lines.push_back(fmt::format("{} {}", side.view == frame::DebugView::Final ? "linear" : view.name,
                                    numbers(glm::dvec3(side.radiance))));
    const glm::u8vec4& code = side.display;
    lines.push_back(fmt::format("shown #{:02x}{:02x}{:02x}  {} {} {}", code.x, code.y, code.z, code.x, code.y, code.z));
}

} // namespace

glm::ivec2 pixelAt(const glm::vec2& place, glm::ivec2 sizePixels) {
    constexpr float kRounding = 1e-3f; // of a pixel: a fraction of the size must not round to the pixel before
    const glm::ivec2 pixel(glm::floor(place * glm::vec2(sizePixels) + kRounding));
    return glm::clamp(pixel, glm::ivec2(0), sizePixels - 1);
}

std::optional<std::size_t> visitsOf(const InspectedSurface& surface, std::optional<std::size_t> ofOpaque) {
    if (surface.isTransparent || surface.mayBeMoved || !ofOpaque) return std::nullopt;
    return surface.isLit ? *ofOpaque : 0;
}

std::vector<std::string> inspectionLines(const Inspection& inspection) {
    std::vector<std::string> lines{fmt::format("{}, {} of {}x{}", inspection.pixel.x, inspection.pixel.y,
                                               inspection.sizePixels.x, inspection.sizePixels.y)};
    const auto& [left, right] = inspection.sides;
    const bool compares = left && right;
    const auto addCompared = [&](const char* name, const InspectedSide& side) {
        lines.emplace_back(name);
        addSide(lines, side);
        if (side.visitedLights) lines.push_back(visits(*side.visitedLights));
    };
    if (inspection.isOfUnshifted) lines.emplace_back("before its edges were smoothed:");
    if (left && !compares) addSide(lines, *left);
    if (compares) {
        addCompared("Left", *left);
        addCompared("Right", *right);
        if (left->view == right->view)
            lines.push_back("difference " + numbers(glm::dvec3(left->radiance) - glm::dvec3(right->radiance)));
    }
    if (!inspection.isSurfaceKnown) return lines;
    if (!inspection.surface) {
        lines.emplace_back("no surface");
        return lines;
    }
    const InspectedSurface& surface = *inspection.surface;
    lines.push_back("material " + surface.material);
    lines.push_back(fmt::format("depth {:.4g} m", surface.depthMetres));
    lines.push_back("shading normal " + numbers(surface.shadingNormalWS));
    lines.push_back("face normal " + numbers(surface.faceNormalWS));
    const std::size_t reaching = surface.reachingLights;
    if (left && left->visitedLights && !compares)
        lines.push_back(
            fmt::format("{}, {} reach{} it", visits(*left->visitedLights), reaching, reaching == 1 ? "es" : ""));
    else
        lines.push_back(
            fmt::format("{} light{} reach{} it", reaching, reaching == 1 ? "" : "s", reaching == 1 ? "es" : ""));
    return lines;
}

void keepPin(std::vector<PinnedInspection>& pins, const glm::vec2& place, const std::vector<std::string>& lines,
             bool isRequested) {
    const auto pin = std::ranges::find(pins, place, &PinnedInspection::place);
    const auto isKnown = [&](const std::string& line) { return std::ranges::find(lines, line) != lines.end(); };
    if (pin == pins.end() && isRequested)
        pins.push_back({place, lines});
    else if (pin != pins.end() && (isRequested || std::ranges::all_of(pin->lines, isKnown)))
        pin->lines = lines;
}

std::optional<InspectedSurface> surfaceAt(const scenes::Scene& scene, const scenes::Camera& camera,
                                          glm::ivec2 sizePixels, glm::ivec2 pixel, double timeSeconds) {
    const std::optional<Pick> picked = pickedByRay(scene, camera, sizePixels, pixel);
    if (!picked) return std::nullopt;
    const glm::dvec3 eyeWS(camera.worldFromCamera[3]), backWS = glm::normalize(glm::dvec3(camera.worldFromCamera[2]));
    const scenes::Mesh& mesh = scene.meshes[std::size_t(picked->mesh)];
    const glm::dmat4 worldFromNode = scenes::worldFromNodes(scene)[std::size_t(picked->node)];
    const auto cornerWS = [&](std::size_t corner) {
        const std::uint32_t index = mesh.indices[3 * std::size_t(picked->triangle) + corner];
        return glm::dvec3(worldFromNode * glm::dvec4(glm::dvec3(mesh.positionsOS[index]), 1.0));
    };
    const glm::dvec3 firstWS = cornerWS(0);
    glm::dvec3 faceNormalWS = glm::normalize(glm::cross(cornerWS(1) - firstWS, cornerWS(2) - firstWS));
    const bool isPerspective = camera.projection == scenes::Projection::Perspective;
    const glm::dvec3 towardsViewerWS = isPerspective ? eyeWS - picked->positionWS : backWS;
    if (glm::dot(faceNormalWS, towardsViewerWS) < 0.0) faceNormalWS = -faceNormalWS;
    const scenes::Material& material = scene.materials[std::size_t(picked->material)];
    InspectedSurface surface;
    surface.material = material.name;
    surface.depthMetres = glm::dot(eyeWS - picked->positionWS, backWS);
    surface.shadingNormalWS = picked->normalWS;
    surface.faceNormalWS = faceNormalWS;
    surface.reachingLights = lightsReaching(scene.lights, picked->positionWS, timeSeconds);
    surface.isTransparent = scenes::isTransparent(material);
    surface.isLit = scenes::infoOf(material.model).isLit;
    surface.mayBeMoved = scene.hook && scene.hook->movesVertices;
    return surface;
}

} // namespace tessera::viewer
