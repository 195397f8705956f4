#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace tessera::viewer {

/// Names of files have letters that a text field cannot hold: beyond 16 bits, control characters, and bytes that are no
/// UTF-8. Letters of Unicode's private use area stand for them in the field, and come back as what they stand for.
class FieldLetters {
public:
    /// A text as a field holds it.
    std::string inField(std::string_view text);
    /// The text that a field holds.
    std::string fromField(std::string_view held) const;

private:
    std::vector<std::string> letters_; ///< what private letters stand for, from the first one on
};

} // namespace tessera::viewer
