#include "viewer/save/RenderCommand.h"

#include <algorithm>

#include <fmt/format.h>

#include "viewer/save/OptionText.h"

namespace tessera::viewer {
namespace {

/// The name in a table of the row for which `matches` holds.
template <typename Table, typename Matches>
std::string nameIn(const Table& table, Matches matches) {
    return std::string(std::ranges::find_if(table, matches)->name);
}

std::string techniqueName(recipes::Technique technique) {
    return nameIn(recipes::techniqueTable(), [&](const auto& row) { return row.technique == technique; });
}

std::string layoutName(const frame::GBufferLayout& layout) {
    return nameIn(frame::layoutTable(), [&](const auto& row) { return row.layout == layout; });
}

std::string toneMapName(frame::ToneMap toneMap) {
    return nameIn(frame::toneMapTable(), [&](const auto& row) { return row.toneMap == toneMap; });
}

std::string sizeText(const glm::ivec2& sizePixels) {
    return fmt::format("{}x{}", sizePixels.x, sizePixels.y);
}

std::string onOff(bool isOn) {
    return isOn ? "on" : "off";
}

class CommandLine {
public:
    CommandLine(const ShownPicture& picture, const scenes::Scene& scene)
        : picture_(picture), settings_(picture.settings), scene_(scene) {}

    std::string options() {
        addWished();
        addCulling();
        addCamera();
        addRest();
        return text_;
    }

private:
    void add(const char* flag, const std::string& value) { text_ += fmt::format(" {} {}", flag, shellWord(value)); }

    /// Says what is not what the program does by itself.
    void addUnless(const char* flag, const std::string& value, const std::string& byItself) {
        if (value != byItself) add(flag, value);
    }

    /// What a scene may ask for: that is the default then.
    void addWished() {
        const scenes::SceneOptions& wish = scene_.options;
        const frame::FrameSettings standard;
        addUnless("--technique", techniqueName(picture_.technique),
                  wish.technique.value_or(techniqueName(recipes::Technique::Deferred)));
        addUnless("--layout", layoutName(settings_.layout), wish.layout.value_or(layoutName(standard.layout)));
        addUnless("--size", sizeText(settings_.sizePixels), sizeText(wish.sizePixels.value_or(standard.sizePixels)));
        addUnless("--exposure", numberText(settings_.exposureEV),
                  numberText(wish.exposureEV.value_or(standard.exposureEV)));
        addUnless("--tonemap", toneMapName(settings_.toneMap), wish.toneMap.value_or(toneMapName(standard.toneMap)));
    }

    void addCulling() {
        const culling::Settings& culling = settings_.culling;
        const auto methodName = [&](const auto& row) { return row.method == culling.method; };
        const auto builderName = [&](const auto& row) { return row.builder == culling.builder; };
        const auto stageName = [&](const auto& row) { return row.stage == settings_.lightOn; };
        if (culling.method) add("--culling", nameIn(culling::methodTable(), methodName));
        if (culling.tilePixels) add("--tile", fmt::format("{}", *culling.tilePixels));
        if (culling.builder) add("--cull-on", nameIn(culling::builderTable(), builderName));
        if (settings_.lightOn) add("--light-on", nameIn(frame::lightingStageTable(), stageName));
    }

    void addCamera() {
        const auto firstCalled = [this](const std::string& name) {
            return int(std::ranges::find(scene_.cameras, name, &scenes::Camera::name) - scene_.cameras.begin());
        };
        const int byItself = scene_.options.camera ? firstCalled(*scene_.options.camera) : 0;
        if (settings_.camera != byItself) {
            const std::string& name = scene_.cameras[std::size_t(settings_.camera)].name;
            const bool isFirst = firstCalled(name) == settings_.camera && !name.empty();
            add("--camera", isFirst ? name : fmt::format("{}", settings_.camera));
        }
        text_ += poseText(picture_.pose);
    }

    void addRest() {
        const frame::FrameSettings standard;
        const auto viewName = [&](const auto& row) { return row.view == settings_.view; };
        const auto filterName = [&](const auto& row) { return row.filter == settings_.filter; };
        const auto spaceName = [&](const auto& row) { return row.space == settings_.space; };
        if (settings_.samples != standard.samples) add("--samples", fmt::format("{}", settings_.samples));
        if (settings_.timeSeconds != 0.0) add("--time", numberText(settings_.timeSeconds));
        if (picture_.lights) add("--lights", fmt::format("{}", *picture_.lights));
        if (!picture_.defaultLight) text_ += " --no-default-light";
        if (settings_.rangeTolerance != 0.0) add("--range-tolerance", numberText(settings_.rangeTolerance));
        if (settings_.view != standard.view) add("--view", nameIn(frame::viewTable(), viewName));
        if (settings_.soloLight) add("--solo", fmt::format("{}", *settings_.soloLight));
        if (settings_.specular != standard.specular) add("--specular", onOff(settings_.specular));
        if (settings_.filter != standard.filter) add("--filter", nameIn(frame::textureFilterTable(), filterName));
        if (settings_.space != standard.space) add("--space", nameIn(frame::lightingSpaceTable(), spaceName));
        if (settings_.prune != standard.prune) add("--prune", onOff(settings_.prune));
    }

    const ShownPicture& picture_;
    const frame::FrameSettings& settings_;
    const scenes::Scene& scene_;
    std::string text_;
};

/// What begins with a dash would be taken for an option.
std::string argument(const std::string& path) {
    return shellWord(path.starts_with('-') ? "./" + path : path);
}

} // namespace

std::string renderCommand(const ShownPicture& picture, const scenes::Scene& scene, const std::string& output) {
    return fmt::format("tessera render {}{} -o {}", argument(picture.source), CommandLine(picture, scene).options(),
                       argument(output));
}

} // namespace tessera::viewer
