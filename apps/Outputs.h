#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::app {

/// Whether a file name stands for standard output: "-". The command then prints nothing else.
bool isStandardOutput(const std::string& path);

/// Throws std::runtime_error early if the file cannot be written.
void requireOutput(const std::string& path);

/// The output files of a command. Ensures that no output is also an input and that no two outputs are the same file;
/// links are followed. Empty names, "-", devices and pipes are ignored.
///
/// Inputs and outputs are registered, in any order, before the work starts; writers call at().
class Outputs {
public:
    Outputs() = default;
    explicit Outputs(const std::vector<std::string>& paths);

    /// Registers an output file. Throws InputError if it is an input or already an output.
    void add(const std::string& path);
    /// Registers a folder in which any file may be written or removed. Throws InputError if it contains an input.
    void addFolder(const std::string& folder);
    /// Registers input files. Throws InputError if one is an output.
    void reads(const std::vector<std::string>& files);

    /// The path to write to. Throws std::logic_error if it was not registered.
    const std::string& at(const std::string& path) const;
    /// Writes the text to standard output, or atomically to a file. Throws std::runtime_error.
    void write(const std::string& path, std::string_view text) const;

private:
    /// Canonical name of a file, which need not exist; empty for a device or a pipe.
    std::string identityOf(const std::string& path) const;
    void requireNotRead(const std::string& file, const std::string& identity) const;

    std::map<std::string, std::string> outputs_;                            ///< names as registered, by identity
    std::set<std::string> folders_, read_;                                  ///< identities
    mutable std::map<std::string, std::filesystem::path> canonicalFolders_; ///< by the folder's name as given
};

} // namespace tessera::app
