#pragma once
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::app {

/// Whether a name given for a file stands for the standard output: "-". What else a command prints is then left out.
bool isStandardOutput(const std::string& path);

/// Throws std::runtime_error where no file of that name can be written, before the work is done in vain.
void requireOutput(const std::string& path);

/// The files that a command writes. An output is never a file that the command reads, and two outputs are never one
/// file; links are followed. Empty names, "-", devices and pipes are no files.
///
/// Both kinds are registered, in any order, before the work starts; writers call at().
class Outputs {
public:
    Outputs() = default;
    explicit Outputs(const std::vector<std::string>& paths);

    /// A file that will be written. Throws InputError where it is read, or is an output already.
    void add(const std::string& path);
    /// A folder in which anything may be written and removed. Throws InputError where a file in it is read.
    void addFolder(const std::string& folder);
    /// Files that the command reads. Throws InputError where one is an output.
    void reads(const std::vector<std::string>& files);

    /// The path to write to. Throws std::logic_error if it was not registered.
    const std::string& at(const std::string& path) const;
    /// Writes the text to the standard output, or as a whole file or not at all. Throws std::runtime_error.
    void write(const std::string& path, std::string_view text) const;

private:
    /// One text for all names of a file, which need not exist; empty for a device or a pipe.
    std::string identityOf(const std::string& path) const;
    void requireNotRead(const std::string& file, const std::string& identity) const;

    std::map<std::string, std::string> outputs_;                            ///< as they were told, by identity
    std::set<std::string> folders_, read_;                                  ///< identities
    mutable std::map<std::string, std::filesystem::path> canonicalFolders_; ///< by the name that outputs give it
};

} // namespace tessera::app
