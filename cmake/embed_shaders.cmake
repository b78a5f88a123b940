# Writes one C++ source with a table of shader name -> SPIR-V words.
# Variables: BINARIES (list), FUNCTION (in namespace graph, returns the table), OUTPUT.
set(arrays "")
set(table "")
foreach(binary ${BINARIES})
    get_filename_component(name ${binary} NAME_WLE) # forward.frag.spv -> forward.frag
    string(MAKE_C_IDENTIFIER "${name}" symbol)
    file(READ ${binary} bytes HEX)
    # The bytes are little-endian 32-bit words.
    string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1," words "${bytes}")
    string(APPEND arrays "constexpr std::uint32_t ${symbol}[] = {${words}};\n")
    string(APPEND table "    {\"${name}\", ${symbol}},\n")
endforeach()
# A C++ array needs at least one element; no shader has the empty name.
if(NOT table)
    string(APPEND arrays "constexpr std::uint32_t none[] = {0};\n")
    set(table "    {\"\", none},\n")
endif()
file(WRITE ${OUTPUT}.tmp "// Generated from SPIR-V by cmake/embed_shaders.cmake.
#include \"engine/graph/embedded_shaders.hpp\"
namespace {
${arrays}
const graph::EmbeddedShader shaders[] = {
${table}};
} // namespace
namespace graph {
std::span<const EmbeddedShader> ${FUNCTION}();
std::span<const EmbeddedShader> ${FUNCTION}() { return shaders; }
} // namespace graph
")
file(RENAME ${OUTPUT}.tmp ${OUTPUT})
