#pragma once
#include <cmath>

#include <glm/glm.hpp>

/// Clamps typed values to those that can be saved (scenes::checkScene) and drawn.
namespace tessera::viewer {

inline constexpr double kMostMetres = 1e9;  ///< of a coordinate, either sign: its square is finite in single precision
inline constexpr double kMostSeconds = 1e9; ///< of time, either sign: thirty years

// Lights; bounds of a type's parameters are in scenes::lightTypes().
inline constexpr float kMostLightColor = 1e6f;
inline constexpr float kMostIntensity = 1e9f;   ///< in the light's own unit
inline constexpr float kMostAttenuation = 1e6f; ///< of A, B and C
inline constexpr float kLeastRangeMetres = 1e-3f;
inline constexpr float kMostRangeMetres = 1e6f;
inline constexpr double kLeastFlickerHertz = 0.1;
inline constexpr double kMostDirection = 1e9; ///< of its components, either sign, before normalisation

// Materials; bounds of a model's parameters are in scenes::materialModels().
/// Of an emission. scenes::checkScene accepts up to 1e30, but the nearest float lies above that; a tenth of it is the
/// round number below.
inline constexpr float kMostRadiance = 1e29f;
inline constexpr float kMostNormalScale = 4.0f;
inline constexpr float kMostFilmIorShown = 3.0f;
inline constexpr float kMostFilmThicknessShown = 2000.0f; ///< nanometres; thicker films are grey
inline constexpr float kMostThicknessShown = 10.0f;       ///< metres, of glass and of its attenuation distance
inline constexpr float kMostDispersionShown = 2.0f;       ///< an Abbe number of 10, below that of any glass

/// Clamps an edited number to its bounds; NaN restores the previous value. An unedited value stays, even if a file has
/// it out of bounds.
template <typename Number>
Number bounded(Number edited, Number before, Number least, Number most) {
    if (edited == before || std::isnan(edited)) return before;
    return glm::clamp(edited, least, most);
}

/// The same per component.
template <glm::length_t N, typename Number>
glm::vec<N, Number> bounded(glm::vec<N, Number> edited, const glm::vec<N, Number>& before, Number least, Number most) {
    for (glm::length_t i = 0; i < N; ++i) edited[i] = bounded(edited[i], before[i], least, most);
    return edited;
}

} // namespace tessera::viewer
