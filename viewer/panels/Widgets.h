#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "viewer/edit/Bounded.h"
#include "viewer/edit/NumberText.h"
#include "viewer/session/History.h"

namespace tessera::viewer {

/// An entry of a list to choose from.
struct Choice {
    std::string_view name;
    std::string_view meaning; ///< tooltip
    bool isPossible = true;   ///< others are shown, but cannot be chosen
};

/// A row of a panel: the label on the left; the next widget takes the rest of the width. The tooltip describes the row
/// (meaningOf()).
void row(const char* label);
void row(const char* label, std::string_view meaning);
/// Continues the row in the column of its widget, to the right of labelWidth().
void secondColumn();
float labelWidth();

/// A drop-down list in its own row. Returns the new choice. Without a meaning, that of the label is used.
std::optional<std::size_t> choose(const char* label, std::string_view shown, std::span<const Choice> choices,
                                  std::size_t chosen, std::string_view meaning = {});
/// The same for any number of entries. Only visible ones are requested, each is drawn before the next request.
std::optional<std::size_t> choose(const char* label, std::string_view shown, std::size_t count,
                                  const std::function<Choice(std::size_t)>& choiceAt, std::size_t chosen,
                                  std::string_view meaning = {});

/// Shows a widget for a value and clamps the new value (bounded()). Returns whether it changed.
template <typename Value, typename Number, typename Widget>
bool edit(Value& value, Number least, Number most, const Widget& widget) {
    Value edited = value;
    if (!widget(edited)) return false;
    edited = bounded(edited, value, least, most);
    return std::exchange(value, edited) != edited;
}

/// The same for a widget that prints its numbers with a printf format: it displays shownNumber(). An unedited value
/// stays bit-identical.
template <typename Value, typename Number, typename Widget>
bool editShown(Value& value, Number least, Number most, const char* format, const Widget& widget) {
    return edit(value, least, most, [&](Value& edited) {
        const Value before = edited, shown = Value(shownNumber(format, before));
        edited = shown;
        if (!widget(edited)) return false;
        edited = unlessShown(edited, shown, before);
        return true;
    });
}

/// Whether the edit of the latest widget is one of many in the same drag.
Gesture widgetGesture();

/// A slider without a label for an int, a float or a double; its grab runs on a rail below the number.
template <typename Number>
bool slideNumber(const char* id, Number& value, Number least, Number most, const char* format,
                 bool isLogarithmic = false);
/// A slider in its own row. Returns whether it changed the value.
bool slider(const char* label, float& value, float least, float most, const char* format = "%.3f");
/// The same with a logarithmic scale.
bool logarithmicSlider(const char* label, float& value, float least, float most, const char* format);
/// The same for an angle, displayed in degrees.
bool angleSlider(const char* label, float& radians, float leastDegrees, float mostDegrees);
/// The first `numbers` components of a vector, without a label; `speed` is their change per pixel of a drag.
bool dragNumbers(const char* id, glm::dvec3& value, int numbers, float speed, double least, double most,
                 const char* format);
/// All of them, in their own row.
bool dragVector(const char* label, glm::dvec3& value, float speed, double most);
/// The channels of a linear colour from 0 to `most` (above 1 for emitters), in their own row. The swatch opens a picker
/// in sRGB.
bool colorRow(const char* label, glm::vec3& color, float most = 1.0f);
/// A square swatch of a linear colour: swatchOfColor().
void colorSwatch(const glm::vec3& linear, float sidePixels);

/// A name of a file, or in a file, as the label of a widget: on one line, and with all characters; Dear ImGui would
/// hide "##" and what follows.
std::string labelOf(std::string_view name);

/// A text shortened to one line of a width: "..." replaces letters in its middle, because file names differ at both
/// ends.
std::string shortened(std::string_view words, float widthPixels);

/// Lets Esc close the list being drawn.
void closeOnEscape();

/// Text over the full width, wrapped.
void paragraph(std::string_view text);
/// The same in the colour of errors.
void errorParagraph(std::string_view text);
/// A texture on the GPU, rows from the top.
struct SmallPicture {
    std::uint32_t texture = 0; ///< GL texture name; 0: none
    glm::vec2 sizePoints{0.0f};
};
/// A tooltip while the pointer rests on the latest item, until that is clicked; an image above the text.
void tip(std::string_view text, const SmallPicture& picture = {});
/// A name and a value in one row.
void fact(const char* label, const std::string& value);

} // namespace tessera::viewer
