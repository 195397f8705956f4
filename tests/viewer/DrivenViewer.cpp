#include "tests/viewer/DrivenViewer.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "tests/viewer/FileDrop.h"

namespace tessera::test {
namespace {

constexpr const char* kLog = "viewer.log";
constexpr double kEndSeconds = 600.0; ///< timeout: a viewer that still runs hangs

void sleepSeconds(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

std::string number(int value) {
    return std::to_string(value);
}

} // namespace

glm::ivec3 Shot::at(glm::ivec2 pixel) const {
    const std::uint8_t* p = &rgb.at(3 * std::size_t(pixel.y * sizePixels.x + pixel.x));
    return {p[0], p[1], p[2]};
}

Shot Shot::part(glm::ivec2 corner, glm::ivec2 size) const {
    Shot cut{size, {}};
    for (int y = corner.y; y < corner.y + size.y; ++y) {
        const auto row = rgb.begin() + 3 * (std::ptrdiff_t(y) * sizePixels.x + corner.x);
        cut.rgb.insert(cut.rgb.end(), row, row + 3 * std::ptrdiff_t(size.x));
    }
    return cut;
}

Shot readShot(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) throw std::runtime_error("cannot read " + file.string() + ": " + OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    if (spec.nchannels < 3) throw std::runtime_error(file.string() + " has no colours");
    Shot shot{{spec.width, spec.height}, std::vector<std::uint8_t>(3 * std::size_t(spec.width * spec.height))};
    if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, shot.rgb.data()))
        throw std::runtime_error("cannot read " + file.string() + ": " + input->geterror());
    return shot;
}

double differingShare(const Shot& a, const Shot& b, int steps) {
    if (a.sizePixels != b.sizePixels || a.rgb.empty()) return 1.0;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
        bool differs = false;
        for (std::size_t c = i; c < i + 3; ++c) differs = differs || std::abs(int(a.rgb[c]) - int(b.rgb[c])) > steps;
        differing += differs ? 1 : 0;
    }
    return double(differing) / double(a.rgb.size() / 3);
}

DrivenViewer::DrivenViewer(const Desktop& desktop, const std::filesystem::path& folder,
                           const std::vector<std::string>& arguments,
                           const std::map<std::string, std::string>& environment)
    : desktop_(desktop), folder_(folder) {
    std::filesystem::remove(folder_ / kLog);
    // Images are compared with rendered ones, whose edges are not smoothed.
    const std::filesystem::path settings = folder_ / "config" / "tessera" / "viewer.json";
    if (!std::filesystem::exists(settings)) {
        std::filesystem::create_directories(settings.parent_path());
        std::ofstream(settings) << R"({"smooths": false})";
    }
    // The log is a file so that it can be read while the viewer writes it.
    std::vector<std::string> command{"sh", "-c", fmt::format("exec \"$@\" >{}", kLog), "sh", TESSERA_PROGRAM, "view"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    command.emplace_back("--log");
    ProcessOptions options{folder_, environment, kEndSeconds};
    options.environment["DISPLAY"] = desktop.display();
    options.environment["XDG_CONFIG_HOME"] = (folder_ / "config").string();
    process_ = std::make_unique<Process>(command, options);
    window_ = desktop_.xdotool({"search", "--sync", "--onlyvisible", "--name", "^Tessera"});
    window_ = window_.substr(0, window_.find('\n'));
    desktop_.xdotool({"windowfocus", "--sync", window_});
}

std::vector<std::string> DrivenViewer::lines() const {
    std::ifstream stream(folder_ / kLog);
    std::vector<std::string> all;
    std::string line;
    while (std::getline(stream, line) && !stream.eof()) all.push_back(line); // the last line may be incomplete
    return all;
}

std::string DrivenViewer::waitFor(const std::string& begin, std::size_t from, double seconds) const {
    constexpr double kPeriodSeconds = 0.005;
    for (double waited = 0.0; waited <= seconds; waited += kPeriodSeconds) {
        const std::vector<std::string> all = lines();
        for (std::size_t i = from; i < all.size(); ++i)
            if (all[i].starts_with(begin)) return all[i];
        sleepSeconds(kPeriodSeconds);
    }
    throw std::runtime_error(
        fmt::format("no \"{}\" within {} s; the log is\n{}", begin, seconds, fmt::join(lines(), "\n")));
}

glm::ivec2 DrivenViewer::waitForWhole(std::size_t from) const {
    // After the latest input, only the whole image is drawn: its line stays the last of its kind.
    constexpr double kStillSeconds = 0.35;
    double still = 0.0;
    std::string latest;
    for (double waited = 0.0; waited <= 120.0; waited += 0.05) {
        const std::vector<std::string> all = lines();
        std::string line;
        for (std::size_t i = from; i < all.size(); ++i)
            if (all[i].starts_with("drawn ")) line = all[i];
        still = !line.empty() && line == latest ? still + 0.05 : 0.0;
        latest = line;
        int frame = 0, width = 0, height = 0;
        double scale = 0.0;
        if (still >= kStillSeconds &&
            std::sscanf(latest.c_str(), "drawn %d scale %lf size %dx%d", &frame, &scale, &width, &height) == 4 &&
            scale == 1.0 && !latest.ends_with(" lacks light"))
            return {width, height};
        sleepSeconds(0.05);
    }
    throw std::runtime_error(fmt::format("no whole picture within 120 s; the log is\n{}", fmt::join(lines(), "\n")));
}

void DrivenViewer::key(const std::string& chord) const {
    desktop_.xdotool({"key", chord});
}

void DrivenViewer::type(const std::string& text) const {
    desktop_.xdotool({"type", "--delay", "40", text});
}

void DrivenViewer::hold(const std::string& key, double seconds) const {
    desktop_.xdotool({"keydown", key, "sleep", fmt::format("{:.3f}", seconds), "keyup", key});
}

void DrivenViewer::moveTo(glm::ivec2 pixel) const {
    desktop_.xdotool({"mousemove", number(pixel.x), number(pixel.y)});
}

void DrivenViewer::click(glm::ivec2 pixel, const std::string& held) const {
    std::vector<std::string> words{"mousemove", number(pixel.x), number(pixel.y), "sleep", "0.1"};
    const auto add = [&words](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
    if (!held.empty()) add({"keydown", held});
    add({"mousedown", "1", "sleep", "0.1", "mouseup", "1", "sleep", "0.1"});
    if (!held.empty()) add({"keyup", held});
    desktop_.xdotool(words);
}

void DrivenViewer::doubleClick(glm::ivec2 pixel) const {
    desktop_.xdotool({"mousemove", number(pixel.x), number(pixel.y), "sleep", "0.1", "click", "--repeat", "2",
                      "--delay", "60", "1", "sleep", "0.1"});
}

void DrivenViewer::drag(glm::ivec2 from, glm::ivec2 to, const std::string& held, int button) const {
    std::vector<std::string> words{"mousemove", number(from.x), number(from.y), "sleep", "0.1"};
    const auto add = [&words](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
    if (!held.empty()) add({"keydown", held});
    add({"mousedown", number(button), "sleep", "0.05"});
    constexpr int kSteps = 10;
    for (int i = 1; i <= kSteps; ++i) {
        const glm::ivec2 at = from + (to - from) * i / kSteps;
        add({"mousemove", number(at.x), number(at.y), "sleep", "0.03"});
    }
    add({"mouseup", number(button)});
    if (!held.empty()) add({"keyup", held});
    desktop_.xdotool(words);
}

void DrivenViewer::wheel(int clicks, const std::string& held) const {
    if (!held.empty()) desktop_.xdotool({"keydown", held});
    desktop_.xdotool({"click", "--repeat", number(std::abs(clicks)), "--delay", "60", clicks > 0 ? "4" : "5"});
    if (!held.empty()) desktop_.xdotool({"keyup", held});
}

void DrivenViewer::drop(glm::ivec2 pixel, const std::vector<std::filesystem::path>& files) const {
    dropFiles(desktop_.display(), window_, pixel, files);
}

void DrivenViewer::resize(glm::ivec2 sizePixels) const {
    desktop_.xdotool({"windowsize", window_, number(sizePixels.x), number(sizePixels.y)});
}

void DrivenViewer::minimise() const {
    desktop_.xdotool({"windowminimize", "--sync", window_});
}

void DrivenViewer::pause(double seconds) const {
    sleepSeconds(seconds);
}

void DrivenViewer::restore() const {
    desktop_.xdotool({"windowmap", "--sync", window_, "windowactivate", "--sync", window_});
}

Shot DrivenViewer::capture() const {
    const std::filesystem::path file = folder_ / "capture.png";
    desktop_.capture(file);
    Shot shot = readShot(file);
    // Kept for inspection if TESSERA_GALLERY names a folder.
    if (const char* gallery = std::getenv("TESSERA_GALLERY")) {
        static int count = 0;
        std::filesystem::copy_file(file, std::filesystem::path(gallery) / fmt::format("viewer-{:02}.png", ++count),
                                   std::filesystem::copy_options::overwrite_existing);
    }
    std::filesystem::remove(file);
    return shot;
}

std::optional<int> DrivenViewer::wait() {
    const ProcessResult result = process_->wait();
    errors_ = result.err;
    return result.exitCode;
}

void DrivenViewer::send(int signal) const {
    process_->send(signal);
}

void DrivenViewer::close() const {
    desktop_.xdotool({"key", "alt+F4"});
}

} // namespace tessera::test
