#include "renderer/shader/ProgramLibrary.h"

#include <algorithm>
#include <exception>
#include <system_error>

#include <fmt/format.h>

#include "base/Error.h"
#include "renderer/shader/HookFault.h"

namespace tessera::shader {
namespace {

/// Name and defines, to distinguish variants in messages.
std::string label(const ProgramDesc& desc) {
    std::string text = desc.name;
    for (std::size_t i = 0; i < desc.defines.size(); ++i) {
        const auto& [name, value] = desc.defines[i];
        text += fmt::format("{}{}{}{}", i == 0 ? " [" : " ", name, value.empty() ? "" : "=", value);
    }
    return desc.defines.empty() ? text : text + "]";
}

std::vector<gpu::StageSource> sources(const std::vector<ExpandedStage>& stages) {
    std::vector<gpu::StageSource> result;
    for (const ExpandedStage& stage : stages) result.push_back({stage.stage, stage.source.text});
    return result;
}

bool sameText(const std::vector<ExpandedStage>& a, const std::vector<ExpandedStage>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ExpandedStage& x, const ExpandedStage& y) {
        return x.stage == y.stage && x.source.text == y.source.text;
    });
}

/// Time of a file's last change; none if it is missing, e.g. while an editor saves it.
std::optional<std::filesystem::file_time_type> timeOf(const std::string& file) {
    std::error_code error;
    const auto time = std::filesystem::last_write_time(file, error);
    return error ? std::nullopt : std::optional(time);
}

/// Whether the program builds with an empty hook.
bool isWholeWithEmptyHook(const SourceTree& tree, const ProgramDesc& desc) {
    const ProgramDesc empty = withEmptyHook(desc);
    try {
        gpu::PendingProgram(label(empty), sources(expandStages(tree, empty))).finish();
        return true;
    } catch (const gpu::ShaderError&) {
        return false;
    }
}

/// A build under way, with the data that maps its errors to source lines.
struct Build {
    ProgramDesc desc;
    std::vector<ExpandedStage> stages;
    gpu::PendingProgram pending;

    Build(const ProgramDesc& ofDesc, std::vector<ExpandedStage> ofStages)
        : desc(ofDesc), stages(std::move(ofStages)), pending(label(ofDesc), sources(stages)) {}

    /// Throws gpu::ShaderError, or InputError where the scene's hook is at fault.
    gpu::Program finish(const SourceTree& tree) {
        try {
            return pending.finish();
        } catch (const gpu::ShaderError& error) {
            std::vector<gpu::ShaderError::StageLog> logs = error.stageLogs();
            for (gpu::ShaderError::StageLog& log : logs)
                for (const ExpandedStage& stage : stages)
                    if (stage.stage == log.stage) log.text = errorsFirst(mapLog(log.text, stage.source.files));
            std::string all = error.linkLog();
            for (const gpu::ShaderError::StageLog& log : logs) all += (all.empty() ? "" : "\n") + log.text;
            while (all.ends_with('\n')) all.pop_back();
            if (!hookFileOf(desc).empty() && (namesHook(desc, all) || isWholeWithEmptyHook(tree, desc)))
                throw InputError(hookFaultText(tree, desc, all));
            throw gpu::ShaderError(error.program(), std::move(logs), error.linkLog());
        }
    }
};

} // namespace

ProgramLibrary::ProgramLibrary(SourceTree tree) : tree_(std::move(tree)), treeChange_(tree_.newestChange()) {}

const gpu::Program& ProgramLibrary::get(const ProgramDesc& desc) {
    std::string key = desc.key();
    auto found = entries_.find(key);
    if (found == entries_.end()) {
        noteHook(desc);
        Build build(desc, expandStages(tree_, desc));
        gpu::Program program = build.finish(tree_);
        auto entry = std::make_unique<Entry>(Entry{desc, std::move(build.stages), std::move(program)});
        found = entries_.emplace(std::move(key), std::move(entry)).first;
    }
    return found->second->program;
}

void ProgramLibrary::warm(std::span<const ProgramDesc> descs) {
    std::exception_ptr firstFault;
    const auto keepGoing = [&firstFault](const auto& step) {
        try {
            step();
        } catch (...) {
            if (!firstFault) firstFault = std::current_exception();
        }
    };
    std::map<std::string, Build> builds;
    for (const ProgramDesc& desc : descs) {
        const std::string key = desc.key();
        if (entries_.contains(key) || builds.contains(key)) continue;
        noteHook(desc);
        keepGoing([&] { builds.try_emplace(key, desc, expandStages(tree_, desc)); });
    }
    for (auto& [key, build] : builds)
        keepGoing([&, &key = key, &build = build] {
            gpu::Program program = build.finish(tree_);
            entries_[key] = std::make_unique<Entry>(Entry{build.desc, std::move(build.stages), std::move(program)});
        });
    if (firstFault) std::rethrow_exception(firstFault);
}

Reloading ProgramLibrary::reload() {
    Reloading result;
    std::vector<std::pair<Entry*, Build>> builds;
    for (auto& [key, entry] : entries_) {
        try {
            std::vector<ExpandedStage> stages = expandStages(tree_, entry->desc);
            if (!sameText(stages, entry->stages))
                builds.emplace_back(entry.get(), Build(entry->desc, std::move(stages)));
        } catch (const InputError& error) {
            result.faults.push_back({error.what(), ""});
        }
    }
    for (auto& [entry, build] : builds) {
        try {
            entry->program = build.finish(tree_);
            entry->stages = std::move(build.stages);
            ++result.programs;
            ++reloaded_;
        } catch (const gpu::ShaderError& error) {
            result.faults.push_back({error.log(), error.program()});
        } catch (const InputError& error) { // its hook is faulty
            result.faults.push_back({error.what(), label(entry->desc)});
        }
    }
    return result;
}

bool ProgramLibrary::sourcesChanged() {
    bool isNew = false;
    const auto look = [&isNew](std::optional<Time>& seen, const std::optional<Time>& now) {
        if (!now || now == seen) return;
        seen = now;
        isNew = true;
    };
    look(treeChange_, tree_.newestChange());
    for (auto& [file, seen] : hooks_) look(seen, timeOf(file));
    return isNew;
}

void ProgramLibrary::noteHook(const ProgramDesc& desc) {
    if (const std::string hook = hookFileOf(desc); !hook.empty() && !hooks_.contains(hook))
        hooks_.emplace(hook, timeOf(hook));
}

} // namespace tessera::shader
