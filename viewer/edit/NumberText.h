#pragma once
#include <string>

#include <glm/glm.hpp>

/// Numbers as the viewer prints them: a number that rounds to zero has no minus, as in "-0.000".
namespace tessera::viewer {

/// The number, without its minus if a printf format of one double would print only zeros. It is not replaced by 0, so
/// that a typed 0 can be distinguished from it.
double shownNumber(const char* format, double value);
/// The same per component.
template <glm::length_t N, typename Number>
glm::vec<N, Number> shownNumber(const char* format, glm::vec<N, Number> value) {
    for (glm::length_t i = 0; i < N; ++i) value[i] = Number(shownNumber(format, double(value[i])));
    return value;
}

/// shownNumber(), printed by its format.
std::string numberText(const char* format, double value);

/// The edited value, or the original one if it still equals the displayed one.
template <typename Number>
Number unlessShown(Number edited, Number shown, Number before) {
    return edited == shown ? before : edited;
}
/// The same per component.
template <glm::length_t N, typename Number>
glm::vec<N, Number> unlessShown(glm::vec<N, Number> edited, const glm::vec<N, Number>& shown,
                                const glm::vec<N, Number>& before) {
    for (glm::length_t i = 0; i < N; ++i) edited[i] = unlessShown(edited[i], shown[i], before[i]);
    return edited;
}

} // namespace tessera::viewer
