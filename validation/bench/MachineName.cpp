#include "validation/bench/MachineName.h"

#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <sys/utsname.h>

namespace tessera::validation {

std::string machineName() {
    std::string processor = "unknown processor";
    std::ifstream cpuinfo("/proc/cpuinfo");
    for (std::string line; std::getline(cpuinfo, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) processor = line.substr(colon + 2);
    }
    utsname system{};
    uname(&system);
    return fmt::format("{} x {}, {} {}", std::thread::hardware_concurrency(), processor, system.sysname,
                       system.machine);
}

} // namespace tessera::validation
