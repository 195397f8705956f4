#pragma once
#include <cstdint>
#include <set>
#include <string_view>
#include <vector>

namespace tessera::viewer {

/// The letters that the interface needs glyphs for: those of western Europe, and any others that occur in texts. A font
/// has tens of thousands, and a scene needs few.
class Letters {
public:
    /// Adds the letters of a UTF-8 text. Those beyond 16 bits, such as emoji, are not supported and ignored.
    void note(std::string_view text);
    /// Once: whether letters were added.
    bool takeNew();
    /// Whether any of them is Chinese, Japanese or Korean, which needs a second font.
    bool hasEastAsian() const;
    /// First and last letter of each range, in ascending order, and a final 0: the format of Dear ImGui.
    std::vector<std::uint16_t> ranges() const;

private:
    std::set<std::uint16_t> more_; ///< in addition to the initial ones
    bool isNew_ = false;
};

} // namespace tessera::viewer
