# Finds the netCDF C library, with HDF5: target NetcdfLibrary::netcdf, variable NetcdfLibrary_FOUND.
find_path(NetcdfLibrary_INCLUDE_DIR netcdf_mem.h HINTS ${HEXWRIGHT_NETCDF_DIR} PATH_SUFFIXES include)
find_library(NetcdfLibrary_LIBRARY netcdf HINTS ${HEXWRIGHT_NETCDF_DIR} PATH_SUFFIXES lib)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(NetcdfLibrary REQUIRED_VARS NetcdfLibrary_LIBRARY NetcdfLibrary_INCLUDE_DIR)
mark_as_advanced(NetcdfLibrary_INCLUDE_DIR NetcdfLibrary_LIBRARY)
if(NetcdfLibrary_FOUND AND NOT TARGET NetcdfLibrary::netcdf)
  add_library(NetcdfLibrary::netcdf UNKNOWN IMPORTED)
  set_target_properties(NetcdfLibrary::netcdf PROPERTIES IMPORTED_LOCATION "${NetcdfLibrary_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${NetcdfLibrary_INCLUDE_DIR}")
endif()
