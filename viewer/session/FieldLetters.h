#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace tessera::viewer {

/// Converts file names for text fields, which cannot hold characters beyond 16 bits, control characters or invalid
/// UTF-8. Characters of Unicode's private use area replace these in the field, and are converted back.
class FieldLetters {
public:
    /// Converts a text for a field.
    std::string inField(std::string_view text);
    /// Converts the text of a field back.
    std::string fromField(std::string_view held) const;

private:
    std::vector<std::string> letters_; ///< the replaced texts, by private-use character from the first on
};

} // namespace tessera::viewer
