// Names of sets that a reader finds, on their way to the mesh.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "io/content/volume_file.h"

namespace hexwright::io {

/// By kind and number of set. Names that say no more than the number ("PATCH_3") are left out.
class SetNames {
 public:
  void add(SetKind kind, std::int64_t number, std::string_view name);
  /// Fills in the names of the file's regions, patches and curves; numbers beyond a million get
  /// none, since no memory is reserved on a file's word.
  void apply(VolumeFile& file) const;

 private:
  std::map<std::pair<SetKind, std::int64_t>, std::string> names_;
};

/// What a format's tags of one kind of set are called, and the numbers they get: that of the name
/// ("PATCH_3" is patch 3, "PATCH_NONE" none), else the tag less one for named sets, patches and
/// curves and the tag itself for regions without a name, else the next that is free; the latter too
/// for tags beyond a million where there are names, which they would cost. Names are added to
/// `names`.
std::map<std::int64_t, std::int32_t> number_tags(SetKind kind,
                                                 const std::map<std::int64_t, std::string>& tags,
                                                 SetNames& names);

}  // namespace hexwright::io
