#pragma once
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "renderer/shader/SourceTree.h"
#include "tests/support/ShaderFolder.h"
#include "tests/support/TempFolder.h"

namespace tessera::test {

/// A copy of the product's shaders with one fault in it.
class ShaderMutant {
public:
    ShaderMutant(const std::string& file, const std::string& from, const std::string& to) : ShaderMutant() {
        replace(file, from, to);
    }
    ShaderMutant() { std::filesystem::copy(shaderFolder(), folder_.path(), std::filesystem::copy_options::recursive); }

    /// Replaces every `from` in a file below shaders/. Throws if there is none, so that a mutant always differs from
    /// the original.
    void replace(const std::string& file, const std::string& from, const std::string& to) const {
        std::ifstream stream(folder_.path() / file, std::ios::binary);
        std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
        std::size_t place = text.find(from);
        if (place == std::string::npos)
            throw std::runtime_error("shaders/" + file + " no longer holds the text that this mutant changes: " + from);
        for (; place != std::string::npos; place = text.find(from, place + to.size()))
            text.replace(place, from.size(), to);
        folder_.write(file, text);
    }

    shader::SourceTree tree() const { return shader::SourceTree(folder_.path()); }

private:
    TempFolder folder_;
};

} // namespace tessera::test
