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

/// One entry of a list to choose from.
struct Choice {
    std::string_view name;
    std::string_view meaning; ///< shown beside the pointer
    bool isPossible = true;   ///< others are shown, but cannot be chosen
};

/// A row of a panel: the label on the left; the next widget takes the rest of the width. While the pointer is there, a
/// box beside it says what the row is about (meaningOf()).
void row(const char* label);
void row(const char* label, std::string_view meaning);
/// Goes on in the row where its widget stands; what is left of that is labelWidth() wide.
void secondColumn();
float labelWidth();

/// A list that drops down, in a row of its own. Returns the new choice. Without a meaning it is that of the label.
std::optional<std::size_t> choose(const char* label, std::string_view shown, std::span<const Choice> choices,
                                  std::size_t chosen, std::string_view meaning = {});
/// The same of any number of entries, of which only visible ones are requested; each is used up before the next.
std::optional<std::size_t> choose(const char* label, std::string_view shown, std::size_t count,
                                  const std::function<Choice(std::size_t)>& choiceAt, std::size_t chosen,
                                  std::string_view meaning = {});

/// Shows a widget of a value and clamps the new value (bounded()). Returns whether it changed.
template <typename Value, typename Number, typename Widget>
bool edit(Value& value, Number least, Number most, const Widget& widget) {
    Value edited = value;
    if (!widget(edited)) return false;
    edited = bounded(edited, value, least, most);
    return std::exchange(value, edited) != edited;
}

/// The same of a widget that prints its numbers by a printf format: as shownNumber() says. What the user does not edit
/// stays to the last bit.
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

/// Whether the edit of a widget that was just shown is one of many that the user makes with it in one go.
Gesture widgetGesture();

/// A slider without a label, of an int, a float or a double: its grab runs on a rail below the number.
template <typename Number>
bool slideNumber(const char* id, Number& value, Number least, Number most, const char* format,
                 bool isLogarithmic = false);
/// A slider in a row of its own. Whether it changed the value.
bool slider(const char* label, float& value, float least, float most, const char* format = "%.3f");
/// The same for values over several powers of ten.
bool logarithmicSlider(const char* label, float& value, float least, float most, const char* format);
/// The same of an angle, which is shown in degrees.
bool angleSlider(const char* label, float& radians, float leastDegrees, float mostDegrees);
/// The first so many components of a vector, without a label; `speed` is theirs a pixel of a drag.
bool dragNumbers(const char* id, glm::dvec3& value, int numbers, float speed, double least, double most,
                 const char* format);
/// All of them, in a row of its own.
bool dragVector(const char* label, glm::dvec3& value, float speed, double most);
/// The channels of a linear colour from 0 to `most`, in a row of its own; above 1 for emitters. Its swatch opens a
/// picker in sRGB.
bool colorRow(const char* label, glm::vec3& color, float most = 1.0f);
/// A square of a linear colour: swatchOfColor().
void colorSwatch(const glm::vec3& linear, float sidePixels);

/// A name of a file, or in one, as the label of a widget: on one line, and with all of its signs; Dear ImGui would hide
/// two "#" and what follows.
std::string labelOf(std::string_view name);

/// A text on one line of a width: where it is longer, "..." stands for letters of its middle. Names of files differ at
/// both ends.
std::string shortened(std::string_view words, float widthPixels);

/// Lets Esc close the list that is being drawn.
void closeOnEscape();

/// Text over the whole width, broken where it must be.
void paragraph(std::string_view text);
/// The same in the colour of errors.
void errorParagraph(std::string_view text);
/// A texture on the GPU, rows from the top.
struct SmallPicture {
    std::uint32_t texture = 0; ///< GL's name; 0: none
    glm::vec2 sizePoints{0.0f};
};
/// A box beside the pointer while it rests on the latest item, until that is clicked; a picture above the words.
void tip(std::string_view text, const SmallPicture& picture = {});
/// A name and a value in one row.
void fact(const char* label, const std::string& value);

} // namespace tessera::viewer
