#include "engine/HookedScene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/Error.h"
#include "engine/HookProgram.h"
#include "shaders/shared/hook.h"
#include "shaders/shared/slots.h"

namespace tessera::engine {

namespace {

/// Vertices per dispatch: 32 MiB, a quarter of the storage block size that OpenGL guarantees.
constexpr std::size_t kMostAtOnce = std::size_t(1) << 20;

/// Rest positions, normals and coordinates of `count` vertices, starting at `first`.
std::vector<shared::HookVertexRow> restOf(const scenes::Mesh& mesh, std::size_t first, std::size_t count) {
    std::vector<shared::HookVertexRow> rest;
    rest.reserve(count);
    for (std::size_t i = first; i < first + count; ++i) {
        const glm::vec3& position = mesh.positionsOS[i];
        const glm::vec3& normal = mesh.normalsOS[i];
        const glm::vec2 uv = mesh.texCoords[0].empty() ? glm::vec2(0.0f) : mesh.texCoords[0][i];
        rest.push_back({{position.x, position.y, position.z}, {normal.x, normal.y, normal.z}, {uv.x, uv.y}});
    }
    return rest;
}

struct MovedVertices {
    std::vector<glm::vec3> positionsOS, normalsOS;
    std::vector<glm::vec4> colors; ///< the mesh's, with flagged opacities if there are any
};

void mark(std::size_t vertex, std::size_t vertices, float opacity, std::vector<glm::vec4>& colors) {
    if (colors.empty()) colors.assign(vertices, glm::vec4(1.0f));
    colors[vertex].a = opacity;
}

/// Larger displacements count as HOOK_MARK_NOWHERE: no scene extends that far.
constexpr double kFarthestMarkedMetres = 1e6;

constexpr std::string_view kNoNumberRemedy =
    "look for a division by 0, a root or a logarithm of less than 0, or a vector without length that it normalizes";

bool isFinite(const glm::vec3& vector) {
    return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

std::string excessText(const scenes::Hook& hook, const scenes::Mesh& mesh, std::size_t vertex, double timeSeconds,
                       double metres, const glm::vec3& normal) {
    const std::string place = fmt::format("{}: at {:g} s hookVertex", hook.file, timeSeconds);
    const std::string which = fmt::format("vertex {} of the mesh '{}'", vertex, mesh.name);
    if (!std::isfinite(metres))
        return fmt::format("{} moves {} to a position that is infinite or NaN; {}", place, which, kNoNumberRemedy);
    if (!isFinite(normal))
        return fmt::format("{} gives {} a normal that is infinite or NaN; {}", place, which, kNoNumberRemedy);
    return fmt::format("{} moves {}", place, which) +
           fmt::format(" by {:g} m, and mayMoveMetres is {:g}; raise that, or move it less", metres,
                       hook.mayMoveMetres);
}

MovedVertices movedVertices(const HookRun& moving, const scenes::Hook& hook, const scenes::Mesh& mesh,
                            double timeSeconds, Excess excess) {
    MovedVertices result;
    result.colors = mesh.colors;
    const std::size_t vertices = mesh.positionsOS.size();
    for (std::size_t first = 0; first < vertices; first += kMostAtOnce) {
        const std::size_t count = std::min(kMostAtOnce, vertices - first);
        const gpu::Buffer given = gpu::Buffer::of("hook rest", restOf(mesh, first, count));
        const auto moved = moving.run<shared::HookMovedRow>(STORAGE_HOOK_REST, given, STORAGE_HOOK_MOVED, count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto& [positionOS, normalOS, isCut] = moved[i];
            glm::vec3 position(positionOS[0], positionOS[1], positionOS[2]);
            const glm::vec3 normal(normalOS[0], normalOS[1], normalOS[2]);
            const glm::vec3& rest = mesh.positionsOS[first + i];
            const double metres = glm::distance(glm::dvec3(position), glm::dvec3(rest));
            // Tolerance for the fp32 rounding of a displacement at the limit.
            const double tolerance = 1e-6 * (hook.mayMoveMetres + glm::length(glm::dvec3(rest)));
            const bool isTooFar = !(metres <= hook.mayMoveMetres + tolerance);
            const bool hasNormal = isFinite(normal);
            static_cast<void>(isCut); // checked by HookRun
            if ((isTooFar || !hasNormal) && excess == Excess::Mark) {
                const bool isNowhere = !(metres <= kFarthestMarkedMetres) || !hasNormal;
                mark(first + i, vertices, float(isNowhere ? HOOK_MARK_NOWHERE : HOOK_MARK_TOO_FAR), result.colors);
                if (isNowhere) position = rest;
            } else if (isTooFar || !hasNormal) {
                throw InputError(excessText(hook, mesh, first + i, timeSeconds, metres, normal));
            }
            // Keeps the rest normal if the new one is unchanged, has no length or is not finite.
            const glm::dvec3 direction(normal);
            const double length = glm::length(direction);
            const bool isKept = normal == mesh.normalsOS[first + i] || !(length > 0.0) || !std::isfinite(length);
            result.positionsOS.push_back(position);
            result.normalsOS.push_back(isKept ? mesh.normalsOS[first + i] : glm::vec3(direction / length));
        }
    }
    return result;
}

} // namespace

HookedScene::HookedScene(const scenes::Scene& scene) : scene_(scene), moved_(scene) {
    const std::set<std::size_t> meshes = scenes::hookedMeshes(scene);
    meshes_.assign(meshes.begin(), meshes.end());
}

HookedScene::Changed HookedScene::update(double timeSeconds, Excess excess, shader::ProgramLibrary& programs) {
    const scenes::Hook& hook = scene_.hook.value();
    const HookRun moving(kHookVertices, hook, timeSeconds, programs);
    std::vector<MovedVertices> all;
    for (const std::size_t mesh : meshes_)
        all.push_back(movedVertices(moving, hook, scene_.meshes[mesh], timeSeconds, excess));

    Changed changed;
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
        scenes::Mesh& mesh = moved_.meshes[meshes_[i]];
        changed.vertices =
            changed.vertices || mesh.positionsOS != all[i].positionsOS || mesh.normalsOS != all[i].normalsOS;
        mesh.positionsOS = std::move(all[i].positionsOS);
        mesh.normalsOS = std::move(all[i].normalsOS);
        changed.colors = changed.colors || mesh.colors != all[i].colors;
        mesh.colors = std::move(all[i].colors);
    }
    takeOthers();
    return changed;
}

void HookedScene::takeOthers() {
    // Names every member of Scene, so that a new one must be handled here.
    const auto& [name, images, materials, meshes, nodes, lights, cameras, rig, environment, hook, background, options,
                 supplied, variants, notes, warnings] = scene_;
    moved_.name = name;
    moved_.materials = materials;
    moved_.nodes = nodes;
    moved_.lights = lights;
    moved_.cameras = cameras;
    moved_.background = background;
    moved_.options = options;
    moved_.hook = hook;
    moved_.hook->movesVertices = false;
    if (moved_.environment && environment) { // orientation and intensity of its map
        moved_.environment->intensity = environment->intensity;
        moved_.environment->rotationDegrees = environment->rotationDegrees;
    }
    static_cast<void>(meshes); // displaced by update(), or copied by takeMeshes()
    static_cast<void>(images); // texels stay as they were loaded
    static_cast<void>(rig);    // has posed the scene already
    static_cast<void>(supplied);
    for (const auto* words : {&variants, &notes, &warnings}) static_cast<void>(words); // not part of the image
}

void HookedScene::takeMeshes() {
    std::vector<std::vector<glm::vec4>> marked; // flagged colours, until update() replaces them
    for (const std::size_t mesh : meshes_) marked.push_back(std::move(moved_.meshes[mesh].colors));
    moved_.meshes = scene_.meshes;
    for (std::size_t i = 0; i < meshes_.size(); ++i) moved_.meshes[meshes_[i]].colors = std::move(marked[i]);
    moved_.nodes = scene_.nodes;
    moved_.materials = scene_.materials;
}

} // namespace tessera::engine
