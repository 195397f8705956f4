# Writes into FOLDER what PROGRAM says of itself: its manual page, compressed as Debian wants it, and its completion.
# Sanitizers would look for leaks of the C++ library's own.
set(ENV{ASAN_OPTIONS} detect_leaks=0)
execute_process(COMMAND ${PROGRAM} manual OUTPUT_FILE ${FOLDER}/tessera.1 COMMAND_ERROR_IS_FATAL ANY)
file(ARCHIVE_CREATE OUTPUT ${FOLDER}/tessera.1.gz PATHS ${FOLDER}/tessera.1 FORMAT raw COMPRESSION GZip)
execute_process(COMMAND ${PROGRAM} completion bash OUTPUT_FILE ${FOLDER}/tessera COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${PROGRAM} completion zsh OUTPUT_FILE ${FOLDER}/_tessera COMMAND_ERROR_IS_FATAL ANY)
