# Writes OUTPUT: a C++ source holding the contents of FILES (separated by |) as string literals. See TesseraEmbed.cmake.
string(REPLACE "|" ";" files "${FILES}")
set(entries "")
foreach(file IN LISTS files)
    file(RELATIVE_PATH path ${ROOT} ${file})
    if(path MATCHES "\\.(ttf|jpg)$")
        file(READ ${file} text HEX)
        string(REGEX REPLACE "(..)" "\\\\x\\1" text "${text}")
        set(begin "\"")
        set(end "\"")
    else()
        file(READ ${file} text)
        set(begin "R\"tessera(")
        set(end ")tessera\"")
    endif()
    string(LENGTH "${text}" length)
    set(literal "\"\"sv ") # with a length: clang ends a constant expression that counts all files' characters
    set(at 0)
    while(at LESS length)
        string(SUBSTRING "${text}" ${at} 8000 piece)
        string(APPEND literal "${begin}${piece}${end}\n")
        math(EXPR at "${at} + 8000")
    endwhile()
    string(APPEND entries "    {\"${path}\", ${literal}},\n")
endforeach()
# The empty last entry keeps the array legal when there is no file; the span leaves it out.
file(WRITE ${OUTPUT} "#include \"${FUNCTION}.gen.h\"
// C++ promises 64 KiB of a literal, put together from pieces; the compilers that build Tessera take any number.
#pragma GCC diagnostic ignored \"-Woverlength-strings\"
namespace ${NAMESPACE} {
using namespace std::string_view_literals;
static constexpr EmbeddedFile kFiles[] = {
${entries}    {}};
std::span<const EmbeddedFile> ${FUNCTION}() { return {kFiles, std::size(kFiles) - 1}; }
} // namespace ${NAMESPACE}
")
