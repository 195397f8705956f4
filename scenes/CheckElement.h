#pragma once
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "scenes/Scene.h"

/// Helpers of the parts of checkScene(): messages that name an element, and checks of numbers.
namespace tessera::scenes {

/// Tolerance of the length of unit vectors and of a rotation's columns: covers the rounding of fp32 and of files with a
/// few decimals, far below the visible.
inline constexpr double kUnitTolerance = 1e-3;

template <typename Vector>
bool allFinite(const Vector& vector) {
    for (glm::length_t i = 0; i < vector.length(); ++i) {
        if (!std::isfinite(vector[i])) return false;
    }
    return true;
}

inline bool allFinite(const glm::dmat4& matrix) {
    return allFinite(matrix[0]) && allFinite(matrix[1]) && allFinite(matrix[2]) && allFinite(matrix[3]);
}

template <typename Vector>
bool allFiniteAndNotNegative(const Vector& vector) {
    for (glm::length_t i = 0; i < vector.length(); ++i) {
        if (!std::isfinite(vector[i]) || vector[i] < 0) return false;
    }
    return true;
}

inline bool between(double value, double low, double high) {
    return value >= low && value <= high; // false for NaN
}

inline bool isUnit(const glm::dvec3& vector) {
    return allFinite(vector) && std::abs(glm::length(vector) - 1.0) <= kUnitTolerance;
}

/// An element of a scene, as named in messages.
class CheckedElement {
public:
    CheckedElement(const Scene& scene, std::string_view kind, std::size_t index, std::string_view name)
        : scene_(scene), kind_(kind), index_(index), name_(name) {}

    /// Throws InputError that names the scene and the element unless the condition holds.
    void require(bool holds, std::string_view problemAndRemedy) const;

    void requireIndex(int index, std::size_t count, std::string_view kind) const;

private:
    const Scene& scene_;
    std::string_view kind_;
    std::size_t index_;
    std::string_view name_;
};

/// Describes bounds in messages.
std::string boundsText(double least, double most);

/// Whether a number, or each component of a vector, lies within the bounds of its field. Other types have no bounds.
template <typename Value, typename Field>
bool isWithin(const Value&, const Field&) {
    return true;
}
/// Bounds are rounded to fp32 like the value, which may round beyond the exact bound.
template <typename Field>
bool isWithin(float value, const Field& field) {
    return value >= float(field.least) && value <= float(field.most); // false for NaN
}
template <glm::length_t Length, typename Field>
bool isWithin(const glm::vec<Length, float>& vector, const Field& field) {
    for (glm::length_t i = 0; i < Length; ++i)
        if (!isWithin(vector[i], field)) return false;
    return true;
}

} // namespace tessera::scenes
