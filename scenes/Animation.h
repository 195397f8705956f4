#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/AnimatedProperties.h"
#include "scenes/Interpolation.h"
#include "scenes/Mesh.h"

/// What moves in a scene, as plain data: clips of keyframes, skins and morph targets. scenes/Pose.h says how the scene
/// looks at a time. Source: glTF 2.0 specification, sections 3.7.3, 3.7.2.2 and 3.11; KHR_animation_pointer.
namespace tessera::scenes {

// ---- Clips ---------------------------------------------------------------------------------------------------------

/// A curve over time: clamped before its first key and after its last.
struct AnimationSampler {
    Interpolation interpolation = Interpolation::Linear;
    int width = 1;                   ///< numbers of a value
    std::vector<float> timesSeconds; ///< of the keys, ascending; at least one
    std::vector<float> values;       ///< by key a value; CubicSpline: in-tangent (1/s), value and out-tangent

    /// How many values a key has.
    std::size_t valuesPerKey() const { return interpolation == Interpolation::CubicSpline ? 3 : 1; }
};

/// The value of a curve at a time, `width` numbers. A rotation is a unit quaternion.
void valueAt(const AnimationSampler& sampler, bool isRotation, double timeSeconds, std::span<double> value);

struct AnimationChannel {
    AnimatedProperty property = AnimatedProperty::Translation;
    int target = 0;     ///< into Rig::nodes, Rig::weights or Rig::numbers, as the property's owner says
    int sampler = 0;    ///< of the clip
    int factor = kNone; ///< another, of one number, which the value is multiplied by
};

struct Clip {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
};

/// When the last key of a clip is.
double lengthSeconds(const Clip& clip);

// ---- What clips change ---------------------------------------------------------------------------------------------

/// A node that a clip moves, and where it stands by itself. parentFromNode is translation * rotation * scale.
struct RestNode {
    int node = 0;
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0}; ///< x, y, z, w of a quaternion that is not zero
    glm::dvec3 scale{1.0};
};

/// A member of a light, a material, a texture's transform or a camera, and what it is by itself (takeRest()).
struct RestNumber {
    AnimatedProperty property = AnimatedProperty::LightColor;
    int element = kNone; ///< light, material or camera of the scene; kNone: it is gone
    glm::dvec4 number{0.0};
    TextureSlot slot = TextureSlot::Count; ///< of AnimatedOwner::Texture: of the material
};

// ---- Deformed meshes -----------------------------------------------------------------------------------------------

struct Skin {
    std::string name;
    std::vector<int> joints;               ///< nodes
    std::vector<glm::dmat4> jointFromBind; ///< by joint, affine: from the space in which the mesh was bound
};

/// What is added to a mesh's attributes, times the target's weight. Each is empty or has the mesh's length.
struct MorphTarget {
    std::vector<glm::vec3> positionsOS;
    std::vector<glm::vec3> normalsOS;
    std::vector<glm::vec3> tangentsOS;
    std::array<std::vector<glm::vec2>, 2> texCoords;
    std::vector<glm::vec4> colors;
};

/// A mesh before it is deformed.
struct Shape {
    Mesh rest;
    bool isFlat = false; ///< normals are those of the triangles, which share no vertices
    std::vector<MorphTarget> targets;
    std::size_t influences = 0;        ///< joints that a vertex follows: 0, 4 or 8
    std::vector<std::uint32_t> joints; ///< of the skin, `influences` a vertex
    std::vector<float> weights;        ///< parallel to joints, not negative
};

/// A mesh of the scene that is a shape deformed. An instance of its own draws it.
struct Deformed {
    int mesh = 0;        ///< of the scene, which poses overwrite
    int shape = 0;       ///< of the rig
    int node = 0;        ///< vertices that follow no joint keep its transform
    int standsAt = 0;    ///< the node that draws the mesh; with a skin one of its own, whose transform poses overwrite
    int skin = kNone;    ///< of the rig
    int weights = kNone; ///< of Rig::weights
};

/// A light or a camera that a node that may move carries along.
struct Carried {
    int element = 0; ///< into Scene::lights or Scene::cameras
    int node = 0;
};

/// Everything that moves or is deformed.
struct Rig {
    std::vector<Clip> clips;
    std::vector<int> playing; ///< clips; of two that change the same thing the later counts
    std::vector<RestNode> nodes;
    std::vector<std::vector<float>> weights; ///< morph weights without a clip, by target
    std::vector<RestNumber> numbers;
    std::vector<Skin> skins;
    std::vector<Shape> shapes;
    std::vector<Deformed> deformed;
    std::vector<Carried> lights, cameras;
};

} // namespace tessera::scenes
