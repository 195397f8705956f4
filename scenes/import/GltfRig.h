#pragma once
#include <set>
#include <tuple>

#include "scenes/import/GltfMaterials.h"
#include "scenes/import/GltfSteps.h"

namespace tessera::scenes::gltf {

// ---- Targets of animation channels: JSON pointers (KHR_animation_pointer), and paths of nodes as pointers -----------

inline constexpr std::string_view kNodesPointer = "/nodes/";
inline constexpr std::string_view kMaterialsPointer = "/materials/";
inline constexpr std::string_view kLightsPointer = "/extensions/KHR_lights_punctual/lights/";
inline constexpr std::string_view kCamerasPointer = "/cameras/";

/// Removes "/nodes/" (`array`), an index and a slash from the start of "/nodes/3/translation"; returns the index.
std::optional<std::size_t> cutIndex(std::string_view& pointer, std::string_view array);

/// The pointer to a channel's target, equal for all channels with the same target in the document.
std::string changedBy(const tiny::AnimationChannel& channel);

/// The document's node whose weights a channel animates; empty for other channels.
std::optional<std::size_t> nodeOfWeights(const tiny::AnimationChannel& channel);

/// By node: whether a channel animates its visibility. False with a matrix, which has no scale to animate.
std::vector<bool> nodesHiddenByClips(const tiny::Model& model);

/// A pointer with "*" for its indices, equal for all targets of a kind: "/cameras/*/orthographic/xmag".
std::string kindOf(std::string_view pointer);

// ---- The rig -------------------------------------------------------------------------------------------------------

/// Builds the scene's rig: mesh deformation (GltfRig.cpp), clips and the targets of their channels (GltfClips.cpp).
class Rigging {
public:
    /// `sceneNodes`: scene node by document node, kNone if it is not in the scene.
    Rigging(Context& context, Materials& materials, std::vector<int> sceneNodes);

    /// How the meshes of a node are deformed.
    Deforms deformsOf(int node) const;
    /// Gives a node separate, deformed instances of its mesh.
    void addDeformed(int node);
    /// Called after a node's camera or light was imported.
    void addCamera(int node);
    void addLight(int node);
    /// Called when all nodes are in the scene: adds the nodes of skinned meshes, and clips.
    void finish();

private:
    struct Drawn {
        int shape = 0;
        int material = 0;
        const tiny::Primitive* primitive = nullptr;
        unsigned lostSets = 0; ///< as ShownMaterial::lostSets
    };
    /// An instance whose node is added later.
    struct Standing {
        std::size_t deformed = 0;
        MeshInstance instance;
    };
    /// The targets of a channel in the scene.
    struct Animated {
        AnimatedProperty property{};
        std::size_t width = 0;         ///< numbers per value
        std::vector<int> targets = {}; ///< as AnimationChannel::target
        double scale = 1.0;            ///< factor of the document's values
        /// Instead of targets: a property that EmissiveStrength or NodeVisibility multiplies, with its unanimated
        /// values.
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
    /// The node whose weights a channel animates although its mesh has no morph targets; else empty.
    std::optional<int> nodeWithoutTargets(const tiny::AnimationChannel& channel) const;
    void warnOfMorphless();
    int restNode(int node);
    int restNumber(AnimatedProperty property, int element, TextureSlot slot = TextureSlot::Count);
    /// Records left-out channels of a pointer for the warning.
    void leaveOut(const std::string& pointer, std::size_t channels);
    void warnOfLeftOut();
    AnimationSampler sampler(int animation, int index, const Animated& animated);
    void carryAll();
    void findHiddenLights();
    void hideAtRest();

    Context& context_;
    Materials& materials_;
    std::vector<int> sceneNodes_;
    std::vector<bool> hasAnimatedWeights_;  ///< by node of the document
    std::vector<std::size_t> targetCounts_; ///< by mesh of the document
    std::vector<bool> isMorphed_;           ///< the same: morphed by its default weights
    std::map<std::tuple<int, Deforms, std::size_t>, std::vector<Drawn>> shapes_; ///< by mesh, deforms and joints
    std::map<int, int> skins_;                                                   ///< rig skin by document skin
    std::map<int, int> weights_, nodes_;                                         ///< rig index by document node
    std::map<std::tuple<AnimatedProperty, int, TextureSlot>, int> numbers_;      ///< number of the rig
    std::vector<Standing> standing_;
    std::map<int, std::vector<int>> lights_, cameras_; ///< scene indices by document index
    std::vector<Carried> carriedLights_, carriedCameras_;
    std::vector<bool> isHiddenByClips_;               ///< nodesHiddenByClips()
    std::map<int, std::vector<int>> lightsHidden_;    ///< scene lights, by nearest ancestor that clips hide
    std::size_t leftOut_ = 0;                         ///< left-out channels
    std::map<std::string, std::string> leftOutPaths_; ///< the first pointer of each kind, by kind
    bool hasMoreLeftOut_ = false;                     ///< more kinds than the warning names
    std::set<int> morphless_;                         ///< document nodes of nodeWithoutTargets()
};

} // namespace tessera::scenes::gltf
