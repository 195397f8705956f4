#include "validation/bench/BenchReport.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "validation/bench/BenchHtml.h"
#include "validation/bench/BenchStore.h"
#include "validation/bench/Recommend.h"

namespace tessera::validation {

namespace {

std::string titleOf(const BenchRecord& record, const BenchGroup& headline) {
    const bool isOneScene = std::all_of(record.groups.begin(), record.groups.end(),
                                        [&](const BenchGroup& group) { return group.scene == headline.scene; });
    if (isOneScene)
        return fmt::format("Which technique for {}?", std::filesystem::path(headline.scene).filename().string());
    return "Which technique for which scene?";
}

double workOf(const BenchGroup& group) {
    return double(group.sizePixels.x) * double(group.sizePixels.y) * (1.0 + double(group.lights));
}

} // namespace

const BenchGroup* headlineGroup(const BenchRecord& record) {
    const BenchGroup* most = nullptr;
    for (const BenchGroup& group : record.groups) {
        if (group.scene == record.groups.front().scene && (!most || workOf(group) > workOf(*most))) most = &group;
    }
    return most;
}

Report benchReport(const BenchRecord& record, const std::string& folder) {
    Report report;
    report.record.renderer = record.renderer;
    std::size_t points = 0;
    for (const BenchGroup& group : record.groups) points += group.results.size();
    report.facts = {{"Machine", record.machine},
                    {"Points", fmt::format("{}{}", points, record.isComplete || record.isShare ? "" : ", unfinished")},
                    {"Frames of each", fmt::format("{}", record.frames)},
                    {"Commit", record.commit},
                    {"OpenGL", record.driver}};
    report.commands = {record.command};
    const BenchGroup* headline = headlineGroup(record);
    if (!headline) {
        report.title = "Nothing is measured yet";
        report.bench = ReportBench{unfinishedHtml(record), ""};
        return report;
    }
    report.title = titleOf(record, *headline);
    report.choice = recommendationText(*headline);
    report.bench =
        benchHtml(record, *headline, [&folder](const std::string& file) { return keptPicture(folder, file); });
    return report;
}

} // namespace tessera::validation
