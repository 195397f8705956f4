#pragma once
#include <string>
#include <string_view>

namespace tessera::shader {

/// A line of GLSL as the preprocessor sees it.
struct Directive {
    std::string name;      ///< "include", "ifdef", ...; empty when the line is no directive
    std::string arguments; ///< what follows the name, comments removed, trimmed
};

/// Recognises directives line by line. Keeps track of block comments and of line continuations, inside which a line
/// that looks like a directive is none.
class LineScanner {
public:
    /// `line` without its end of line. Lines have to be given in order.
    Directive next(std::string_view line);
    /// True after a line inside which a block comment or a continuation is still open.
    bool isOpen() const { return inBlockComment_ || inContinuation_; }
    /// The last line without its comments and a backslash at its end.
    const std::string& code() const { return code_; }

private:
    std::string withoutComments(std::string_view line);
    std::string code_;
    bool inBlockComment_ = false;
    bool inLineComment_ = false; ///< only carried to the next line by a continuation
    bool inContinuation_ = false;
};

} // namespace tessera::shader
