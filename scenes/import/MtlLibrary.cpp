#include "scenes/import/MtlLibrary.h"

#include <algorithm>
#include <map>
#include <system_error>

#include <fmt/format.h>

#include "scenes/import/ObjLines.h"

namespace tessera::scenes::obj {
namespace {

bool isFile(const std::filesystem::path& path) {
    std::error_code failure;
    return std::filesystem::is_regular_file(path, failure);
}

/// The files an mtllib statement names: one name that may hold spaces, or several without.
std::vector<std::string> fileNamesOf(const std::string& statement, const std::filesystem::path& folder) {
    if (isFile(folder / statement)) return {statement};
    std::vector<std::string> names;
    forEachLine("mtllib " + statement, [&](const Line& line) { names.assign(line.words.begin(), line.words.end()); });
    // If there is no file of that name, a message should show the whole statement.
    const bool someExist = std::ranges::any_of(names, [&](const std::string& name) { return isFile(folder / name); });
    return someExist ? names : std::vector<std::string>{statement};
}

} // namespace

std::vector<MtlMaterial> findMaterials(const std::vector<std::string>& names, const std::vector<std::string>& libraries,
                                       const std::filesystem::path& objFile, std::vector<std::string>& warnings,
                                       LoadLedger& ledger) {
    std::map<std::string, MtlMaterial> defined;
    std::set<std::string> visited;
    for (const std::string& statement : libraries) {
        for (const std::string& name : fileNamesOf(statement, objFile.parent_path())) {
            if (!visited.insert(name).second) continue;
            const std::filesystem::path file = objFile.parent_path() / name;
            if (!isFile(file)) {
                warnings.push_back(fmt::format("{}: its material library '{}' is missing; default materials are used",
                                               objFile.string(), name));
                continue;
            }
            for (MtlMaterial& material : readMtl(file, warnings, ledger))
                defined.emplace(material.name, std::move(material));
        }
    }
    std::vector<MtlMaterial> found;
    for (const std::string& name : names) {
        if (const auto material = defined.find(name); material != defined.end()) {
            found.push_back(material->second);
            continue;
        }
        warnings.push_back(fmt::format("{}: no material library defines '{}'; a default material of that name is used",
                                       objFile.string(), name));
        MtlMaterial undefined;
        undefined.name = name;
        found.push_back(std::move(undefined));
    }
    return found;
}

} // namespace tessera::scenes::obj
