#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "scenes/Scene.h"

namespace tessera::viewer {

/// A draggable point of a light's outline, or the end of an arm. Image positions are those of a PictureView.
struct LightHandle {
    int number = 0; ///< index among its light's handles, including those that cannot be grabbed
    /// The parameter that it changes; null: a corner, an arm or the light's direction.
    const scenes::LightParameter* parameter = nullptr;
    int corner = scenes::kNone; ///< corner that it moves, in the plane of the light's outline
    int arm = scenes::kNone;    ///< world axis along which it moves the light: 0 is x, 1 y and 2 z
    glm::dvec3 axisWS{0.0};     ///< unit drag axis, from the light's middle; zero for corners
    bool isRound = false;       ///< it lies where lines of sight touch the surface, and follows them
    double share = 1.0; ///< fraction of the parameter between middle and handle: all of a radius, half of a side
    glm::dvec3 positionWS{0.0};
    glm::dvec2 truePlace{0.0}; ///< image position of positionWS
    glm::dvec2 place{0.0};     ///< where it is drawn and grabbed: clear of the light's marker and other handles
    glm::dvec2 way{0.0};       ///< unit drag direction in the image; zero if it is dragged freely

    /// Whether it turns the light's direction.
    bool turns() const { return isDraggedAnywhere() && corner == scenes::kNone; }
    /// Whether it is one of the arms that move the light.
    bool moves() const { return arm != scenes::kNone; }
    /// World axis of an arm.
    char axisName() const { return "xyz"[arm]; }
    bool isDraggedAnywhere() const { return parameter == nullptr && !moves(); }
};

/// The handle nearest to a position, within `reach` of it.
std::optional<std::size_t> handleAt(std::span<const LightHandle> handles, const glm::dvec2& place, double reach);

/// Tooltip of an arm, whose axis is otherwise shown by its colour alone: "Drag to move along x". Empty for other
/// handles: the outline shows what they change.
std::string hintOf(const LightHandle& handle);

/// Pointer shape for the drag direction of a handle.
enum class PointerShape { LeftRight, UpDown, Falling, Rising, AnyWay };
PointerShape pointerShapeOf(const LightHandle& handle);

} // namespace tessera::viewer
