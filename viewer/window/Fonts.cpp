#include "viewer/window/Fonts.h"

#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include <imgui.h>

#include "validation/pictures/Lettering.h"

namespace tessera::viewer {
namespace {

static_assert(sizeof(ImWchar) == sizeof(std::uint16_t));

/// Font files of distributions for Chinese, Japanese and Korean; the first that exists is used.
constexpr const char* kEastAsianFontFiles[] = {
    "/usr/share/fonts/opentype/noto/NotoSansCJK-Regular.ttc", // fonts-noto-cjk
    "/usr/share/fonts/google-noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/noto-cjk/NotoSansCJK-Regular.ttc",
    "/usr/share/fonts/truetype/wqy/wqy-microhei.ttc",
    "/usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf",
    "/System/Library/Fonts/PingFang.ttc",
    "C:/Windows/Fonts/msyh.ttc",
};

/// Adds a font from a copy of its bytes, which the atlas frees.
void add(std::string_view bytes, const ImFontConfig& config) {
    void* const owned = ImGui::MemAlloc(bytes.size());
    std::memcpy(owned, bytes.data(), bytes.size());
    ImGui::GetIO().Fonts->AddFontFromMemoryTTF(owned, int(bytes.size()), config.SizePixels, &config,
                                               config.GlyphRanges);
}

void addEastAsian(const ImFontConfig& config) {
    for (const char* file : kEastAsianFontFiles) {
        std::ifstream stream(file, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
        if (stream && !bytes.empty()) return add(bytes, config);
    }
}

} // namespace

void applyFonts(const Letters& letters, float heightPixels, std::vector<std::uint16_t>& ranges) {
    ImGui::GetIO().Fonts->Clear();
    ranges = letters.ranges();
    for (const float sizePixels : {heightPixels, titlePixels(heightPixels)}) {
        ImFontConfig config;
        config.SizePixels = sizePixels;
        config.GlyphRanges = ranges.data();
        add(validation::fontFile(), config);
        config.MergeMode = true;
        if (letters.hasEastAsian()) addEastAsian(config);
    }
}

} // namespace tessera::viewer
