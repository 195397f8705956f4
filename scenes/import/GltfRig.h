#pragma once
#include <set>
#include <tuple>

#include "scenes/import/GltfMaterials.h"
#include "scenes/import/GltfSteps.h"

namespace tessera::scenes::gltf {

// ---- What channels of animations point at: JSON pointers of KHR_animation_pointer, and paths of nodes as such -------

inline constexpr std::string_view kNodesPointer = "/nodes/";
inline constexpr std::string_view kMaterialsPointer = "/materials/";
inline constexpr std::string_view kLightsPointer = "/extensions/KHR_lights_punctual/lights/";
inline constexpr std::string_view kCamerasPointer = "/cameras/";

/// Cuts "/nodes/" and a number from the begin of "/nodes/3/translation", and the slash after.
std::optional<std::size_t> cutIndex(std::string_view& pointer, std::string_view array);

/// A pointer to what a channel changes, the same for all channels that change the same thing of the document.
std::string changedBy(const tiny::AnimationChannel& channel);

/// The node whose weights a channel changes, by number of the document; none: it changes something else.
std::optional<std::size_t> nodeOfWeights(const tiny::AnimationChannel& channel);

/// By node: whether a channel hides and shows it, which a node with a matrix has no scale for.
std::vector<bool> nodesHiddenByClips(const tiny::Model& model);

/// A pointer without its numbers, which is the same for all things of a kind: "/cameras/*/orthographic/xmag".
std::string kindOf(std::string_view pointer);

// ---- The rig -------------------------------------------------------------------------------------------------------

/// Builds the scene's rig: what deforms meshes (GltfRig.cpp), clips, and what in the scene their channels change
/// (GltfClips.cpp).
class Rigging {
public:
    /// `sceneNodes` is by node of the document the scene's, kNone where the scene does not have it.
    Rigging(Context& context, Materials& materials, std::vector<int> sceneNodes);

    /// What deforms the meshes of a node.
    Deforms deformsOf(int node) const;
    /// Gives a node instances of its own of its mesh deformed.
    void addDeformed(int node);
    /// Called when a node's camera or light was imported.
    void addCamera(int node);
    void addLight(int node);
    /// Called when all nodes are in the scene: adds those that skinned meshes stand at, and clips.
    void finish();

private:
    struct Drawn {
        int shape = 0;
        int material = 0;
        const tiny::Primitive* primitive = nullptr;
        unsigned lostSets = 0; ///< as ShownMaterial::lostSets
    };
    /// An instance whose node is not there yet.
    struct Standing {
        std::size_t deformed = 0;
        MeshInstance instance;
    };
    /// What a channel changes.
    struct Animated {
        AnimatedProperty property{};
        std::size_t width = 0;         ///< numbers of a value
        std::vector<int> targets = {}; ///< as AnimationChannel::target
        double scale = 1.0;            ///< of the document's values
        /// Instead of targets: what EmissiveStrength and NodeVisibility multiply, with its values where no clip changes
        /// it.
        struct Multiplied {
            AnimatedProperty property{};
            int target = 0; ///< as AnimationChannel::target
            std::vector<float> rest;
        };
        std::vector<Multiplied> multiplied = {};
    };

    const std::vector<Drawn>& shapesOf(int mesh, Deforms deforms, std::size_t joints);
    std::vector<float> restWeights(int node) const;
    int skinOf(int index);
    void readMatrices(int accessor, int skin, std::vector<glm::dmat4>& jointFromBind) const;
    /// Vertices without weight follow joint 0. Source: glTF repository, issue 1929; three.js does so.
    void mendInfluences(Shape& shape, int mesh, int skin, std::size_t joints) const;
    void addSkinnedNodes();

    Clip clip(int index);
    std::optional<Animated> animated(const tiny::AnimationChannel& channel);
    std::optional<Animated> animatedOfNode(int node, std::string_view path);
    Animated visibilityOf(int node);
    std::optional<Animated> animatedOfLight(std::size_t index, std::string_view path);
    std::optional<Animated> animatedOfMaterial(std::size_t index, std::string_view path);
    std::optional<Animated> animatedOfTexture(std::size_t material, std::string_view path);
    std::optional<Animated> animatedOfCamera(std::size_t index, std::string_view path);
    /// The node whose weights a channel changes though its mesh has no morph targets; none: another channel.
    std::optional<int> nodeWithoutTargets(const tiny::AnimationChannel& channel) const;
    void warnOfMorphless();
    int restNode(int node);
    int restNumber(AnimatedProperty property, int element, TextureSlot slot = TextureSlot::Count);
    /// Notes that channels of a pointer are left out.
    void leaveOut(const std::string& pointer, std::size_t channels);
    void warnOfLeftOut();
    AnimationSampler sampler(int animation, int index, const Animated& animated);
    void carryAll();
    void findHiddenLights();
    void hideAtRest();

    Context& context_;
    Materials& materials_;
    std::vector<int> sceneNodes_;
    std::vector<bool> hasAnimatedWeights_;                                       ///< by node of the document
    std::vector<std::size_t> targetCounts_;                                      ///< by mesh of the document
    std::vector<bool> isMorphed_;                                                ///< the same: by its own weights
    std::map<std::tuple<int, Deforms, std::size_t>, std::vector<Drawn>> shapes_; ///< by mesh and number of joints
    std::map<int, int> skins_;                                              ///< of the rig, by those of the document
    std::map<int, int> weights_, nodes_;                                    ///< of the rig, by nodes of the document
    std::map<std::tuple<AnimatedProperty, int, TextureSlot>, int> numbers_; ///< of the rig
    std::vector<Standing> standing_;
    std::map<int, std::vector<int>> lights_, cameras_; ///< of the scene, by those of the document
    std::vector<Carried> carriedLights_, carriedCameras_;
    std::vector<bool> isHiddenByClips_;               ///< nodesHiddenByClips()
    std::map<int, std::vector<int>> lightsHidden_;    ///< of the scene, by the next node above that clips hide and show
    std::size_t leftOut_ = 0;                         ///< channels
    std::map<std::string, std::string> leftOutPaths_; ///< the first of each kind, by its kind
    bool hasMoreLeftOut_ = false;                     ///< kinds than are named
    std::set<int> morphless_;                         ///< nodes of nodeWithoutTargets(), of the document
};

} // namespace tessera::scenes::gltf
