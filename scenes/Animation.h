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

/// Animation data of a scene: keyframe clips, skins and morph targets; scenes/Pose.h evaluates it at a time. Source:
/// glTF 2.0 specification, sections 3.7.3, 3.7.2.2 and 3.11; KHR_animation_pointer.
namespace tessera::scenes {

// ---- Clips ---------------------------------------------------------------------------------------------------------

/// A curve over time: clamped before its first key and after its last.
struct AnimationSampler {
    Interpolation interpolation = Interpolation::Linear;
    int width = 1;                   ///< components of a value
    std::vector<float> timesSeconds; ///< key times, ascending; at least one
    std::vector<float> values;       ///< one per key; CubicSpline: in-tangent (1/s), value and out-tangent

    /// Number of values per key.
    std::size_t valuesPerKey() const { return interpolation == Interpolation::CubicSpline ? 3 : 1; }
};

/// Evaluates a curve at a time into `value`, which has `width` components. Rotations are unit quaternions.
void valueAt(const AnimationSampler& sampler, bool isRotation, double timeSeconds, std::span<double> value);

struct AnimationChannel {
    AnimatedProperty property = AnimatedProperty::Translation;
    int target = 0;     ///< index into Rig::nodes, Rig::weights or Rig::numbers, depending on the property's owner
    int sampler = 0;    ///< index into Clip::samplers
    int factor = kNone; ///< index of a scalar sampler that multiplies the value; kNone: none
};

struct Clip {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
};

/// Time of a clip's last key.
double lengthSeconds(const Clip& clip);

// ---- Animated properties -------------------------------------------------------------------------------------------

/// A node that clips move, with its rest transform. parentFromNode is translation * rotation * scale.
struct RestNode {
    int node = 0;
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0}; ///< quaternion x, y, z, w; not zero
    glm::dvec3 scale{1.0};
};

/// An animatable member of a light, material, texture transform or camera, with its rest value (takeRest()).
struct RestNumber {
    AnimatedProperty property = AnimatedProperty::LightColor;
    int element = kNone; ///< index of the scene's light, material or camera; kNone: no longer animated
    glm::dvec4 number{0.0};
    TextureSlot slot = TextureSlot::Count; ///< AnimatedOwner::Texture: the material's texture slot
};

// ---- Deformed meshes -----------------------------------------------------------------------------------------------

struct Skin {
    std::string name;
    std::vector<int> joints;               ///< node indices
    std::vector<glm::dmat4> jointFromBind; ///< by joint, affine: inverse bind matrices
};

/// Offsets added to a mesh's attributes, scaled by the target's weight. Each list is empty or has an entry per vertex.
struct MorphTarget {
    std::vector<glm::vec3> positionsOS;
    std::vector<glm::vec3> normalsOS;
    std::vector<glm::vec3> tangentsOS;
    std::array<std::vector<glm::vec2>, 2> texCoords;
    std::vector<glm::vec4> colors;
};

/// An undeformed mesh with its morph targets and skinning weights.
struct Shape {
    Mesh rest;
    bool isFlat = false; ///< flat shading: normals are per triangle, and triangles share no vertices
    std::vector<MorphTarget> targets;
    std::size_t influences = 0;        ///< joints per vertex: 0, 4 or 8
    std::vector<std::uint32_t> joints; ///< indices into Skin::joints, `influences` per vertex
    std::vector<float> weights;        ///< parallel to joints, not negative
};

/// A mesh of the scene that holds a deformed shape. A dedicated instance draws it.
struct Deformed {
    int mesh = 0;        ///< index into Scene::meshes; poses overwrite the mesh
    int shape = 0;       ///< index into Rig::shapes
    int node = 0;        ///< transforms the vertices without joints
    int standsAt = 0;    ///< node that draws the mesh; with a skin a dedicated one, whose transform poses overwrite
    int skin = kNone;    ///< index into Rig::skins
    int weights = kNone; ///< index into Rig::weights
};

/// A light or camera attached to a node that may move.
struct Carried {
    int element = 0; ///< index into Scene::lights or Scene::cameras
    int node = 0;
};

/// Everything in a scene that is animated or deformed.
struct Rig {
    std::vector<Clip> clips;
    std::vector<int> playing; ///< indices of active clips; the last one that changes a property wins
    std::vector<RestNode> nodes;
    std::vector<std::vector<float>> weights; ///< rest morph weights, by target
    std::vector<RestNumber> numbers;
    std::vector<Skin> skins;
    std::vector<Shape> shapes;
    std::vector<Deformed> deformed;
    std::vector<Carried> lights, cameras;
};

} // namespace tessera::scenes
