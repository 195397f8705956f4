#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Animation.h"
#include "scenes/Camera.h"
#include "scenes/Environment.h"
#include "scenes/Hook.h"
#include "scenes/Image.h"
#include "scenes/Light.h"
#include "scenes/Material.h"
#include "scenes/Mesh.h"

/// Scene data as authored: nothing is packed for a GPU, and nothing is stored that a renderer can derive (tangents,
/// culling radii, cone scales). World space is right-handed, Y up, metres; colours are linear unless a texture slot
/// says otherwise. Absent indices are -1.
namespace tessera::scenes {

// ---- Geometry ------------------------------------------------------------------------------------------------------

struct Box3 {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};
    bool empty() const { return min.x > max.x; }
    void extend(const glm::dvec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
};

/// A mesh drawn with a material, at a node.
struct MeshInstance {
    int mesh = kNone;
    int material = kNone;
    bool castsShadow = true; ///< only if its material does too
};

/// A node of the transform hierarchy; parents precede their children.
struct Node {
    std::string name;
    int parent = kNone;
    glm::dmat4 parentFromNode{1.0};
    std::vector<MeshInstance> instances;
};

// ---- Lights --------------------------------------------------------------------------------------------------------

/// Stateless factor of the intensity, so that times can be evaluated in any order: 1 + amplitude / 4 * sum over k in
/// {17, 29, 43, 64} of sin(2 pi (k frequency t / 64 + phase_k)), with phases derived from the seed. It repeats after 64
/// / frequency seconds; its mean is 1.
double flickerAt(const LightFlicker& flicker, double timeSeconds);

/// Whether a light changes over time.
bool movesByItself(const Light& light);

/// Whether a path's points are not all in one place.
bool hasLength(const LightAnimation& path);

/// Whether the light has keyframes of a member other than the position.
bool hasKeys(const Light& light, LightKeyed of);

/// Sets a member, scalars to x, clamped to the bounds of its field: splines overshoot their keys.
void setKeyed(Light& light, LightKeyed member, const glm::dvec3& value);

/// The light at `timeSeconds`, with its animation, keyframes and flicker applied.
Light lightAtTime(const Light& light, double timeSeconds);

// ---- Options, scene -------------------------------------------------------------------------------------------------

/// A setting's value as requested in a scene's file.
using OptionValue = std::variant<bool, double, std::string, std::vector<double>>;

/// Options requested by a scene, which the user's options override.
struct SceneOptions {
    std::optional<std::string> camera;
    std::optional<std::string> clip;  ///< as in playClip(); none: the first of each model is active
    std::optional<bool> defaultLight; ///< false: supply no light if the scene has none
    std::map<std::string, OptionValue, std::less<>> requested; ///< requested settings, by key (engine::settingTable())
    bool operator==(const SceneOptions&) const = default;
};

/// Supplied defaults for what a scene's file lacks, or on request in place of its own (scenes/Defaults.h).
struct Supplied {
    bool camera = false, light = false;
    double fillShare = 0.0;       ///< fraction of a full studio's intensity, if it complements the scene's own lights
    bool replacesCameras = false; ///< the supplied camera replaces the scene's own
    int exposureEV = 0;           ///< whole stops, if its lights are much too bright or too dim for a display
    bool isInside = false;        ///< the supplied camera is inside the scene, which surrounds it (scenes/Enclosure.h)
    std::set<std::string> requested; ///< keys of SceneOptions::requested that no file requested
    bool operator==(const Supplied&) const = default;
};

struct Scene {
    std::string name;
    std::vector<Image> images;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<Light> lights; ///< in document order: glTF depth first, then those of the .json
    std::vector<Camera> cameras;
    Rig rig; ///< empty if nothing moves and nothing is skinned or morphed
    std::optional<Environment> environment;
    std::optional<Hook> hook;
    glm::vec3 background{0.0f}; ///< linear radiance where nothing is drawn and no environment is displayed
    SceneOptions options;
    Supplied supplied;
    std::vector<std::string> variants; ///< unique names of all material variants (ImportOptions::variant)
    std::vector<std::string> notes;    ///< importer choices that are worth knowing but lose nothing
    std::vector<std::string> warnings; ///< what the importer left out or changed, each naming the feature
};

/// Finds a camera by name, else by number from 0; included files may repeat names. None if there is no such camera.
std::optional<std::size_t> cameraCalled(const Scene& scene, std::string_view nameOrNumber);

/// World-from-node of every node, in double precision.
std::vector<glm::dmat4> worldFromNodes(const Scene& scene);

/// World bounds of everything drawn; empty() when nothing is.
Box3 worldBounds(const Scene& scene);

/// Number of triangles drawn, counting each instance.
std::size_t triangleCount(const Scene& scene);

/// Indices of the meshes drawn with a material of the scene's hook. The scene must have a hook.
std::set<std::size_t> hookedMeshes(const Scene& scene);

/// Throws InputError unless everything drawn and all lights and cameras attached to nodes lie within kFarthestMetres of
/// the origin: the part of checkScene() that a pose may violate.
void checkPlaces(const Scene& scene);

/// Throws InputError unless every index is in range, every attribute has its mesh's length and every number is finite
/// (a light's infinite range and a camera's infinite far plane excepted). The message names the scene and the element.
void checkScene(const Scene& scene);
/// The same for an environment that a scene is about to use.
void checkEnvironment(const Scene& scene, const Environment& environment);

} // namespace tessera::scenes
