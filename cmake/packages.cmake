# In: the packages of this machine. Out: the targets to link to, SAHL_PUBLIC_LIBRARIES and SAHL_PRIVATE_LIBRARIES, and
# SAHL_MISSING: a line for each package that is not here, with the name that Debian and Ubuntu give it.
# The build reads this file, and so does sahlConfig.cmake: who links to a static libsahl links to the same.
set(SAHL_PUBLIC_LIBRARIES "")
set(SAHL_PRIVATE_LIBRARIES "")
set(SAHL_MISSING "")

# sahl_need(<list> <name> <Debian package> <target>...): the first of the targets that exists goes on the list.
macro(sahl_need list name debian)
  set(sahl_found "")
  foreach(sahl_target ${ARGN})
    if(NOT sahl_found AND TARGET ${sahl_target})
      set(sahl_found ${sahl_target})
    endif()
  endforeach()
  if(sahl_found)
    list(APPEND ${list} ${sahl_found})
  else()
    string(APPEND SAHL_MISSING "  ${name}: apt-get install ${debian}\n")
  endif()
endmacro()

find_package(glm CONFIG QUIET)
sahl_need(SAHL_PUBLIC_LIBRARIES "GLM" libglm-dev glm::glm)

find_package(embree 4 CONFIG QUIET)
if(NOT embree_FOUND)
  find_package(embree 3.13 CONFIG QUIET)
endif()
sahl_need(SAHL_PRIVATE_LIBRARIES "Embree 3.13 or 4" libembree-dev embree)

find_package(TBB CONFIG QUIET)
sahl_need(SAHL_PRIVATE_LIBRARIES "TBB" libtbb-dev TBB::tbb)

find_package(OpenSSL QUIET COMPONENTS Crypto)
sahl_need(SAHL_PRIVATE_LIBRARIES "OpenSSL's libcrypto" libssl-dev OpenSSL::Crypto)

find_package(OpenMesh CONFIG QUIET)
sahl_need(SAHL_PRIVATE_LIBRARIES "OpenMesh" libopenmesh-dev OpenMeshTools)
sahl_need(SAHL_PRIVATE_LIBRARIES "OpenMesh" libopenmesh-dev OpenMeshCore)

find_package(TinyGLTF CONFIG QUIET)
sahl_need(SAHL_PRIVATE_LIBRARIES "tinygltf" libtinygltf-dev TinyGLTF::TinyGLTF tinygltf::tinygltf)

find_package(tinyobjloader CONFIG QUIET)
sahl_need(SAHL_PRIVATE_LIBRARIES "tinyobjloader, in double precision" libtinyobjloader-dev
          tinyobjloader::tinyobjloader_double)

find_package(tomlplusplus CONFIG QUIET)
sahl_need(SAHL_PRIVATE_LIBRARIES "toml++" libtomlplusplus-dev tomlplusplus::tomlplusplus)

# OpenImageIO's own CMake files ask, on Debian, for targets that no package has. Of HDF5 only the serial build will do,
# and the plain name `hdf5` may be the one for MPI.
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(SAHL_OPENIMAGEIO QUIET IMPORTED_TARGET OpenImageIO)
  pkg_check_modules(SAHL_HDF5 QUIET IMPORTED_TARGET hdf5-serial)
  pkg_check_modules(SAHL_ISAL QUIET IMPORTED_TARGET libisal)
else()
  string(APPEND SAHL_MISSING "  pkg-config: apt-get install pkgconf\n")
endif()
sahl_need(SAHL_PRIVATE_LIBRARIES "OpenImageIO" libopenimageio-dev PkgConfig::SAHL_OPENIMAGEIO)
sahl_need(SAHL_PRIVATE_LIBRARIES "HDF5, serial" libhdf5-dev PkgConfig::SAHL_HDF5)
sahl_need(SAHL_PRIVATE_LIBRARIES "ISA-L" libisal-dev PkgConfig::SAHL_ISAL)
