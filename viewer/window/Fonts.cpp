#include "viewer/window/Fonts.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

#include <imgui.h>

namespace tessera::viewer {
namespace {

static_assert(sizeof(ImWchar) == sizeof(std::uint16_t));

/// Where distributions put fonts of wide coverage, the first that is there counts.
constexpr const char* kFontFiles[] = {
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", // Debian, Ubuntu: fonts-dejavu-core
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",  "/usr/share/fonts/noto/NotoSans-Regular.ttf",
    "/System/Library/Fonts/Supplemental/Arial Unicode.ttf", "C:/Windows/Fonts/segoeui.ttf",
};
/// The same of Chinese, Japanese and Korean.
constexpr const char* kEastAsianFontFiles[] = {
    "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc", // fonts-noto-cjk
    "/usr/share/fonts/google-noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
    "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
    "/System/Library/Fonts/PingFang.ttc",
    "C:/Windows/Fonts/msyh.ttc",
};

/// Adds the first font that is there; false where none is.
bool addFirst(std::span<const char* const> files, ImFontConfig config) {
    for (const char* file : files) {
        std::ifstream stream(file, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
        if (!stream || bytes.empty()) continue;
        void* const owned = ImGui::MemAlloc(bytes.size()); // freed with the font
        std::memcpy(owned, bytes.data(), bytes.size());
        ImGui::GetIO().Fonts->AddFontFromMemoryTTF(owned, int(bytes.size()), config.SizePixels, &config,
                                                   config.GlyphRanges);
        return true;
    }
    return false;
}

} // namespace

void applyFonts(const Letters& letters, float heightPixels, std::vector<std::uint16_t>& ranges) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    ranges = letters.ranges();
    for (const float sizePixels : {heightPixels, titlePixels(heightPixels)}) {
        ImFontConfig config;
        config.SizePixels = sizePixels;
        config.GlyphRanges = ranges.data();
        if (!addFirst(kFontFiles, config)) {
            config.GlyphRanges = nullptr;
            fonts.AddFontDefault(&config);
            return;
        }
        config.MergeMode = true;
        if (letters.hasEastAsian()) addFirst(kEastAsianFontFiles, config);
    }
}

} // namespace tessera::viewer
