# Finds the HiGHS solver: target HiGHS::highs, variable HiGHS_FOUND.
#
# Looked for in HEXWRIGHT_HIGHS_DIR, CMAKE_PREFIX_PATH, and where
# `python3 -m pip install --target build/deps highsbox` puts it.
find_path(HiGHS_INCLUDE_DIR highs/interfaces/highs_c_api.h
  HINTS ${HEXWRIGHT_HIGHS_DIR} ${PROJECT_SOURCE_DIR}/build/deps/highsbox/highs_dist
  PATH_SUFFIXES include)
find_library(HiGHS_LIBRARY highs
  HINTS ${HEXWRIGHT_HIGHS_DIR} ${PROJECT_SOURCE_DIR}/build/deps/highsbox/highs_dist
  PATH_SUFFIXES lib)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HiGHS REQUIRED_VARS HiGHS_LIBRARY HiGHS_INCLUDE_DIR)
mark_as_advanced(HiGHS_INCLUDE_DIR HiGHS_LIBRARY)
if(HiGHS_FOUND AND NOT TARGET HiGHS::highs)
  add_library(HiGHS::highs UNKNOWN IMPORTED)
  set_target_properties(HiGHS::highs PROPERTIES IMPORTED_LOCATION "${HiGHS_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${HiGHS_INCLUDE_DIR};${HiGHS_INCLUDE_DIR}/highs")
endif()
