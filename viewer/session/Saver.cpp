#include "viewer/session/Saver.h"

#include <filesystem>
#include <string_view>

#include "validation/PictureFile.h"
#include "validation/Rendering.h"
#include "validation/ShownPicture.h"
#include "viewer/session/FreePath.h"

namespace tessera::viewer {

std::string Saver::stem() const {
    return std::filesystem::path(state_.open->source()).stem().string();
}

void Saver::tell(const std::string& path) {
    state_.notice = {"Saved " + std::filesystem::absolute(path).string(), false};
    log_.line("saved " + path);
}

void Saver::picture(glm::ivec2 sizePixels, const char* ending) {
    Look look = state_.active();
    look.settings.sizePixels = sizePixels;
    look.settings.display = std::string_view(ending) != ".exr";
    const recipes::RenderedFrame frame = screen_.renderer()->render(look.technique, look.settings);
    const std::string path = freePath(stem(), ending).string();
    if (look.settings.display) {
        validation::writePng(
            path, validation::shownPicture(frame, state_.open->scene().name, look.technique, look.settings.view));
    } else {
        validation::writeExr(path, validation::toPicture(frame));
    }
    tell(path);
}

} // namespace tessera::viewer
