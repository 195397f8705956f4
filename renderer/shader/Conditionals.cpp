#include "renderer/shader/Conditionals.h"

#include <algorithm>
#include <cctype>

namespace tessera::shader {
namespace {

std::string withoutSpaces(std::string text) {
    std::erase_if(text, [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
    return text;
}

} // namespace

void Conditionals::follow(const Directive& directive) {
    if (directive.name == "ifdef") {
        branches_.push_back(directive.arguments == "__cplusplus" ? Branch::Cpp : Branch::Other);
    } else if (directive.name == "ifndef") {
        branches_.push_back(directive.arguments == "__cplusplus" ? Branch::Glsl : Branch::Other);
    } else if (directive.name == "if") {
        const std::string condition = withoutSpaces(directive.arguments);
        const bool isCpp = condition == "defined(__cplusplus)" || condition == "defined__cplusplus";
        const bool isGlsl = condition == "!defined(__cplusplus)" || condition == "!defined__cplusplus";
        branches_.push_back(isCpp ? Branch::Cpp : isGlsl ? Branch::Glsl : Branch::Other);
    } else if (branches_.empty()) {
        return;
    } else if (directive.name == "else" || directive.name == "elif") {
        Branch& branch = branches_.back();
        branch = branch == Branch::Cpp ? Branch::Glsl : branch == Branch::Glsl ? Branch::Cpp : Branch::Other;
    } else if (directive.name == "endif") {
        branches_.pop_back();
    }
}

bool Conditionals::inCpp() const {
    return std::find(branches_.begin(), branches_.end(), Branch::Cpp) != branches_.end();
}

} // namespace tessera::shader
