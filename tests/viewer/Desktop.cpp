#include "tests/viewer/Desktop.h"

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

namespace tessera::test {
namespace {

constexpr double kLongSeconds = 3600.0; ///< timeout of programs that end with the test
constexpr const char* kManagerSettings = R"(<?xml version="1.0"?>
<openbox_config xmlns="http://openbox.org/3.4/rc">
  <theme><keepBorder>no</keepBorder></theme>
  <keyboard><keybind key="A-F4"><action name="Close"/></keybind></keyboard>
  <mouse><dragThreshold>1</dragThreshold></mouse>
  <applications>
    <application class="*"><decor>no</decor><position force="yes"><x>0</x><y>0</y></position></application>
  </applications>
</openbox_config>
)";

/// Waits until the server accepts connections and has written the number of its display.
std::string readDisplay(const std::filesystem::path& file) {
    for (int i = 0; i < 600; ++i) {
        std::ifstream stream(file);
        std::string number;
        if (std::getline(stream, number) && !stream.eof()) return ":" + number;
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    throw std::runtime_error("Xvfb did not start within 30 s; is the package xvfb installed?");
}

ProcessResult checked(const std::vector<std::string>& command, const std::string& display) {
    ProcessResult result = runProcess(command, {{}, {{"DISPLAY", display}}, 60.0});
    if (result.exitCode != 0)
        throw std::runtime_error(fmt::format("{} failed: {}", fmt::join(command, " "), result.err));
    return result;
}

} // namespace

Desktop::Desktop(glm::ivec2 sizePixels) : sizePixels_(sizePixels) {
    const std::string script =
        fmt::format("exec Xvfb -displayfd 3 -screen 0 {}x{}x24 -nolisten tcp 3>display", sizePixels.x, sizePixels.y);
    server_ = std::make_unique<Process>(std::vector<std::string>{"sh", "-c", script},
                                        ProcessOptions{folder_.path(), {}, kLongSeconds});
    display_ = readDisplay(folder_.path() / "display");
    const std::string settings = folder_.write("openbox.xml", kManagerSettings).string();
    // The manager registers with the screen's root window when it is ready. If it misses its start, which happens once
    // in hundreds, it is started again.
    for (int start = 0; start < 4; ++start) {
        manager_ = std::make_unique<Process>(std::vector<std::string>{"openbox", "--config-file", settings},
                                             ProcessOptions{folder_.path(), {{"DISPLAY", display_}}, kLongSeconds});
        for (int i = 0; i < 200; ++i) {
            const ProcessResult answer = runProcess({"xdotool", "get_desktop"}, {{}, {{"DISPLAY", display_}}, 10.0});
            if (answer.exitCode == 0 && answer.err.empty()) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }
    throw std::runtime_error("Openbox did not start within 40 s; is the package openbox installed?");
}

std::string Desktop::xdotool(const std::vector<std::string>& words) const {
    std::vector<std::string> command{"xdotool"};
    command.insert(command.end(), words.begin(), words.end());
    return checked(command, display_).out;
}

void Desktop::capture(const std::filesystem::path& file) const {
    // Little compression takes a fifth of the time.
    checked({"import", "-silent", "-window", "root", "-quality", "1", "png24:" + file.string()}, display_);
}

} // namespace tessera::test
