#include "viewer/show/ReloadShaders.h"

#include <map>
#include <utility>

#include <fmt/format.h>

namespace tessera::viewer {

void reloadShaders(shader::ProgramLibrary& library, State& state, const EventLog& log, bool isRequested) {
    const shader::Reloading done = library.reload();
    std::map<std::string, std::vector<std::string>> programs; // by the error that they share
    for (const shader::ShaderFault& fault : done.faults) {
        std::vector<std::string>& having = programs[fault.text];
        if (!fault.program.empty()) having.push_back(fault.program);
    }
    const bool hadFaults = !state.shaderFaults.empty();
    state.shaderFaults.clear();
    for (auto& [text, having] : programs) {
        log.line("shader error " + text);
        state.shaderFaults.push_back({text, std::move(having)});
    }
    if (programs.empty()) {
        log.line("shaders reloaded");
        if (done.programs > 0)
            state.notice = {
                fmt::format("Shaders reloaded: {} program{} compiled", done.programs, done.programs == 1 ? "" : "s"),
                false};
        else if (hadFaults)
            state.notice = {"Shaders reloaded: their errors are gone", false};
        else if (isRequested)
            state.notice = {"Shaders reloaded: nothing has changed in them", false};
    }
}

} // namespace tessera::viewer
