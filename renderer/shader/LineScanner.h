#pragma once
#include <string>
#include <string_view>

namespace tessera::shader {

/// The preprocessor directive of a line of GLSL.
struct Directive {
    std::string name;      ///< "include", "ifdef", ...; empty when the line is no directive
    std::string arguments; ///< text after the name, without comments, trimmed
};

/// Recognises directives line by line, except inside block comments and line continuations.
class LineScanner {
public:
    /// Scans a line without its line ending. Lines must be passed in order.
    Directive next(std::string_view line);
    /// True after a line inside which a block comment or a continuation is still open.
    bool isOpen() const { return inBlockComment_ || inContinuation_; }
    /// The last line without comments and a trailing backslash.
    const std::string& code() const { return code_; }

private:
    std::string withoutComments(std::string_view line);
    std::string code_;
    bool inBlockComment_ = false;
    bool inLineComment_ = false; ///< only carried to the next line by a continuation
    bool inContinuation_ = false;
};

} // namespace tessera::shader
