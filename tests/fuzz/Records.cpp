#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>

#include "base/Error.h"
#include "tests/fuzz/Readers.h"
#include "validation/bench/BenchMatrix.h"
#include "validation/bench/BenchMerge.h"
#include "validation/bench/BenchParts.h"
#include "validation/bench/BenchReport.h"
#include "validation/bench/BenchStore.h"

namespace tessera::fuzz {
namespace {

namespace fs = std::filesystem;

std::string textOf(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// Writes a record in every output format.
void writeAll(const std::string& folder) {
    const validation::BenchRecord record = validation::recordIn(folder);
    validation::benchJson(record);
    validation::benchCsv(record);
    validation::benchTable(record);
    validation::unfinishedText(record);
    if (!record.groups.empty()) validation::benchReport(record, folder);
}

} // namespace

/// Reports, merges and resumes a stored run: the first line is run.json, the rest its first group.
void readBench(const fs::path& file) {
    const fs::path bench = file.parent_path() / "bench", merged = file.parent_path() / "merged";
    const std::string text = textOf(file);
    const std::size_t end = std::min(text.find('\n'), text.size());
    fs::remove_all(merged);
    fs::create_directories(validation::partsOf(bench.string()));
    std::ofstream(validation::runFile(bench.string()), std::ios::binary) << text.substr(0, end);
    std::ofstream(validation::groupFile(bench.string(), 0), std::ios::binary)
        << text.substr(std::min(end + 1, text.size()));
    const validation::Json run = validation::runIn(bench.string());
    writeAll(bench.string());
    {
        const validation::RunIdentity identity{.machine = run.at("machine"),
                                               .renderer = run.at("renderer"),
                                               .driver = run.at("driver"),
                                               .commit = run.at("commit"),
                                               .settings = run.at("settings"),
                                               .against = run.at("against"),
                                               .frames = run.at("frames"),
                                               .shard = run.at("shard").at(0),
                                               .shards = run.at("shard").at(1),
                                               .command = run.at("command")};
        try {
            validation::BenchStore(bench.string(), identity, {}, validation::EarlierRun::Resume);
        } catch (const InputError&) { // the stored groups differ from the empty plan
        }
    }
    validation::mergeRuns({bench.string()}, merged.string());
    writeAll(merged.string());
    validation::mergeMachines(validation::shardsByMachine({bench.string()}), (merged / "of_machines").string());
}

void readMatrix(const fs::path& file) {
    scenes::LoadLedger ledger(kMemoryLimitBytes);
    validation::parseMatrix(textOf(file), file.string(), ledger);
}

} // namespace tessera::fuzz
