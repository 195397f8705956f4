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

/// A scene as plain data, as its author wrote it: nothing here is packed for a GPU and nothing is derived that a
/// renderer could derive (tangents, culling radii, cone scales). World space is right-handed, Y up, metres; colours are
/// linear unless a texture slot says otherwise. Indices are -1 where something is absent.
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
    bool castsShadow = true; ///< as long as its material does too
};

/// Transform hierarchy; a parent always stands before its children.
struct Node {
    std::string name;
    int parent = kNone;
    glm::dmat4 parentFromNode{1.0};
    std::vector<MeshInstance> instances;
};

// ---- Lights --------------------------------------------------------------------------------------------------------

/// The factor of the intensity at `timeSeconds`, a function of nothing else, so that times can be asked for in any
/// order: 1 + amplitude / 4 * sum over k in {17, 29, 43, 64} of sin(2 pi (k frequency t / 64 + phase_k)), with phases
/// of the seed. Its mean over 64 / frequency seconds, after which it repeats, is 1.
double flickerAt(const LightFlicker& flicker, double timeSeconds);

/// Whether a light is not the same at all times.
bool movesByItself(const Light& light);

/// Whether a path's points are not all in one place.
bool hasLength(const LightAnimation& path);

/// Whether there are keyframes of a member but the position.
bool hasKeys(const Light& light, LightKeyed of);

/// Gives a member a value, x of a number, within the bounds of its field: splines go past their keys.
void setKeyed(Light& light, LightKeyed member, const glm::dvec3& value);

/// The light as it is at `timeSeconds`: its animation applied to its position, its keyframes to what they are of, its
/// flicker to its intensity.
Light lightAtTime(const Light& light, double timeSeconds);

// ---- Options, scene -------------------------------------------------------------------------------------------------

/// The value that a scene asks for of a setting, as its file has it.
using Wish = std::variant<bool, double, std::string, std::vector<double>>;

/// What a scene asks for where the user does not say otherwise.
struct SceneOptions {
    std::optional<std::string> camera;
    std::optional<std::string> clip;                 ///< as playClip() takes it; none: the first of each model plays
    std::optional<bool> defaultLight;                ///< false: where there is no light, none is supplied
    std::map<std::string, Wish, std::less<>> wishes; ///< by the settings' keys (engine::settingTable())
    bool operator==(const SceneOptions&) const = default;
};

/// What a scene is given that its file lacks, or that was asked for in the place of its own (scenes/Defaults.h).
struct Supplied {
    bool camera = false, light = false;
    double fillShare = 0.0;       ///< of the supplied light's brightness, beside lights of the scene's own
    bool replacesCameras = false; ///< the camera stands in the place of the scene's own
    int exposureEV = 0;           ///< whole stops, where its lights are much too bright or too dim for a display
    bool isInside = false;        ///< the camera stands within the scene, which surrounds it (scenes/Enclosure.h)
    std::set<std::string> wishes; ///< keys of SceneOptions::wishes that no file asked for
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
    Rig rig; ///< empty where nothing moves and nothing is skinned or morphed
    std::optional<Environment> environment;
    std::optional<Hook> hook;
    glm::vec3 background{0.0f}; ///< radiance where nothing is drawn and no environment is shown, linear
    SceneOptions options;
    Supplied supplied;
    std::vector<std::string> variants; ///< names that ImportWishes::variant may have, of all models, once each
    std::vector<std::string> notes; ///< what the importer chose, where a reader may want to know, and nothing is lost
    std::vector<std::string> warnings; ///< what the importer left out, each naming the feature
};

/// The camera that a name chooses, else a number counted from 0: an included file may bring a camera of a name that is
/// there already. None where there is no such camera.
std::optional<std::size_t> cameraCalled(const Scene& scene, std::string_view nameOrNumber);

/// World-from-node of every node, in double precision.
std::vector<glm::dmat4> worldFromNodes(const Scene& scene);

/// World bounds of everything drawn; empty() when nothing is.
Box3 worldBounds(const Scene& scene);

/// Triangles drawn, instances counted each.
std::size_t triangleCount(const Scene& scene);

/// The meshes drawn with a material that the hook of a scene that has one changes.
std::set<std::size_t> hookedMeshes(const Scene& scene);

/// Throws InputError unless everything drawn lies within kFarthestMetres of the origin, and the lights and cameras that
/// nodes carry do: the part of checkScene() that a pose may break.
void checkPlaces(const Scene& scene);

/// Throws InputError unless every index is in range, every attribute has its mesh's length and every number is finite
/// (a light's infinite range and a camera's infinite far plane excepted). The text names the scene and the element.
void checkScene(const Scene& scene);
/// The same of an environment that is to become a scene's.
void checkEnvironment(const Scene& scene, const Environment& environment);

} // namespace tessera::scenes
