# Writes OUTPUT: a C++ source with the commit that SOURCE_DIR stands at, "unknown" outside a repository. Left alone when it
# says so already, so that nothing is compiled anew.
execute_process(COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
    set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#include \"apps/Version.h\"\nconst char* const tessera::app::kCommit = \"${commit}\";\n")
