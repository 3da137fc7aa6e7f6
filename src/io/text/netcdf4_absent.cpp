// Stands in for the reader of netCDF-4 files where the program was built without the library.
#include "io/text/file_bytes.h"
#include "io/text/netcdf_file.h"

namespace hexwright::io {

std::unique_ptr<NetcdfFile> open_netcdf4(std::string_view, const std::string& file_name) {
  throw bad_file(
      file_name,
      "this is an HDF5 file, as netCDF-4 writes it, which this build cannot read; rewrite "
      "it by `nccopy -k cdf5 IN OUT`, or build with -DHEXWRIGHT_NETCDF=ON (needs the "
      "netCDF library)");
}

}  // namespace hexwright::io
