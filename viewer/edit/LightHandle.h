#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "scenes/Scene.h"

namespace tessera::viewer {

/// A point that is dragged: of a light's outline, or the end of an arm. Places are those of a PictureView.
struct LightHandle {
    int number = 0; ///< among those of its light, whether or not all of them can be taken
    /// That it changes; null: a corner, an arm or the light's direction.
    const scenes::LightParameter* parameter = nullptr;
    int corner = scenes::kNone; ///< that it moves, in the plane of the light's outline
    int arm = scenes::kNone;    ///< the world's axis along which it moves the light: 0 is x, 1 y and 2 z
    glm::dvec3 axisWS{0.0};     ///< unit, from the light's middle: the way it is dragged; none of a corner
    bool isRound = false;       ///< it is where lines of sight touch the surface, and keeps to them
    double share = 1.0; ///< of the parameter that lies between middle and handle: all of a radius, half of a side
    glm::dvec3 positionWS{0.0};
    glm::dvec2 truePlace{0.0}; ///< of positionWS
    glm::dvec2 place{0.0};     ///< where it is drawn and taken: not too near to the light's marker and to other handles
    glm::dvec2 way{0.0};       ///< unit: the way it is dragged in the picture; none of what is dragged anywhere

    /// Whether it is the direction's.
    bool turns() const { return isDraggedAnywhere() && corner == scenes::kNone; }
    /// Whether it is one of the arms, which move the light.
    bool moves() const { return arm != scenes::kNone; }
    /// Of an arm: the world's axis along which it moves the light.
    char axisName() const { return "xyz"[arm]; }
    bool isDraggedAnywhere() const { return parameter == nullptr && !moves(); }
};

/// The handle nearest to a place, within `reach` of it.
std::optional<std::size_t> handleAt(std::span<const LightHandle> handles, const glm::dvec2& place, double reach);

/// What the user is told who points at an arm, whose axis its colour alone would say: "Drag to move along x". Empty of
/// other handles: the outline shows what they change.
std::string hintOf(const LightHandle& handle);

/// How a pointer says which way a handle goes.
enum class PointerShape { LeftRight, UpDown, Falling, Rising, AnyWay };
PointerShape pointerShapeOf(const LightHandle& handle);

} // namespace tessera::viewer
