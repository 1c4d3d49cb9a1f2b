# In: a built tree. Out: success, if what it installs is enough to build and run tests/install/ against, and its program runs.
# Variables: build, config, generator, compiler, flags, source.
set(prefix "${build}/installed")
set(outside "${build}/outside_program")
file(REMOVE_RECURSE "${prefix}" "${outside}")

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run("${CMAKE_COMMAND}" --install "${build}" --config "${config}" --prefix "${prefix}")
run("${CMAKE_COMMAND}" -S "${source}/tests/install" -B "${outside}" -G "${generator}"
    -D "CMAKE_PREFIX_PATH=${prefix}" -D "CMAKE_BUILD_TYPE=${config}"
    -D "CMAKE_CXX_COMPILER=${compiler}" -D "CMAKE_CXX_FLAGS=${flags}")
run("${CMAKE_COMMAND}" --build "${outside}" --config "${config}")
run("${outside}/outside" "${source}/tests/install/ball.toml")
run("${prefix}/bin/sahl" --help)
