// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/result/h5.h"

#include <hdf5.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "geo/base/check.h"
#include "io/base/names.h"

namespace sunload::h5 {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t), "Handle holds an identifier");

struct Messages {
  std::string outermost, innermost;
};

herr_t collect(unsigned level, const H5E_error2_t* error, void* messages) {
  auto& found = *static_cast<Messages*>(messages);
  const std::string text = error->desc != nullptr ? error->desc : "";
  if (level == 0) found.outermost = text;
  if (!text.empty()) found.innermost = text;
  return 0;
}

/// The library's own words, from what was wanted to what went wrong; of a system
/// error its text alone (the library adds addresses and times).
std::string error_text(const std::string& action) {
  Messages messages;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, &collect, &messages);
  H5Eclear2(H5E_DEFAULT);
  const std::string marker = "error message = '";
  if (const auto begin = messages.innermost.find(marker); begin != std::string::npos) {
    const auto from = begin + marker.size();
    messages.innermost =
        messages.innermost.substr(from, messages.innermost.find('\'', from) - from);
  }
  std::string text = action + ": " + messages.outermost;
  if (messages.innermost != messages.outermost) text += ": " + messages.innermost;
  return text;
}

[[noreturn]] void fail(const std::string& action) { throw Error(error_text(action)); }

/// Why something could not be closed: with a dataset its unwritten chunks are
/// lost. Owners cannot throw then; the closing of the file tells.
std::string& failed_closing() {
  static std::string text;
  return text;
}

/// Passes on what is not negative.
template <class Result>
Result checked(Result result, const std::string& action) {
  if (result < 0) fail(action);
  return result;
}

template <class Close>
Handle handle(hid_t id, Close close, const std::string& action) {
  return {new std::int64_t(checked(id, action)), [close](const std::int64_t* owned) {
            if (close(*owned) < 0) failed_closing() = error_text("writing");
            delete owned;
          }};
}

/// Before the first use. Errors become exceptions: the library prints nothing.
/// Files are closed by their owners: it has nothing to do at the end of the process.
void set_up_library() {
  [[maybe_unused]] static const herr_t no_clean_up = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Handle text_type() {
  auto type = handle(H5Tcopy(H5T_C_S1), &H5Tclose, "text type");
  checked(H5Tset_size(*type, H5T_VARIABLE), "text type");
  checked(H5Tset_cset(*type, H5T_CSET_UTF8), "text type");
  return type;
}

/// Type in the file: little-endian everywhere.
Handle stored_type(Type type) {
  switch (type) {
    case Type::int8:
      return handle(H5Tcopy(H5T_STD_I8LE), &H5Tclose, "type");
    case Type::int32:
      return handle(H5Tcopy(H5T_STD_I32LE), &H5Tclose, "type");
    case Type::int64:
      return handle(H5Tcopy(H5T_STD_I64LE), &H5Tclose, "type");
    case Type::float32:
      return handle(H5Tcopy(H5T_IEEE_F32LE), &H5Tclose, "type");
    case Type::float64:
      return handle(H5Tcopy(H5T_IEEE_F64LE), &H5Tclose, "type");
    case Type::text:
      return text_type();
  }
  SUNLOAD_EXPECT(false, "unknown type");
}

std::vector<hsize_t> sizes(const std::vector<std::size_t>& values) {
  return {values.begin(), values.end()};
}

Handle space_of(const std::vector<std::size_t>& shape) {
  if (shape.empty()) return handle(H5Screate(H5S_SCALAR), &H5Sclose, "scalar");
  const auto dims = sizes(shape);
  return handle(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), &H5Sclose,
                "shape");
}

Handle space_of_dataset(hid_t dataset) { return handle(H5Dget_space(dataset), &H5Sclose, "shape"); }

std::size_t element_count(const std::vector<std::size_t>& shape) {
  std::size_t count = 1;
  for (const std::size_t size : shape) {
    if (size != 0 && count > std::numeric_limits<std::size_t>::max() / sizeof(double) / size) {
      throw Error("the shape is impossibly large");
    }
    count *= size;
  }
  return count;
}

/// A damaged header may claim any size: what is read must be there. Of chunked
/// datasets, whose unwritten rows take no room and whose zeros take little, only
/// what no file of that length stands for is refused.
void expect_stored(hid_t dataset, std::size_t values) {
  const auto properties = handle(H5Dget_create_plist(dataset), &H5Pclose, "properties");
  if (H5Pget_layout(*properties) == H5D_CHUNKED) {
    constexpr std::size_t at_least = 20'000'000, per_byte = 64;
    hsize_t file_bytes = 0;
    const auto file = handle(H5Iget_file_id(dataset), &H5Fclose, "file");
    checked(H5Fget_filesize(*file, &file_bytes), "file");
    if (values > at_least + per_byte * file_bytes)
      throw Error("more values than the file can hold");
    return;
  }
  const auto type = handle(H5Dget_type(dataset), &H5Tclose, "type");
  if (H5Dget_storage_size(dataset) < values * H5Tget_size(*type)) throw Error("data are missing");
}

/// Selects rows [first, first + count) of a dataset; returns file and memory space.
std::pair<Handle, Handle> rows_selected(hid_t dataset, std::vector<std::size_t> shape,
                                        std::size_t first, std::size_t count) {
  SUNLOAD_EXPECT(!shape.empty() && first + count <= shape[0], "rows of a dataset");
  shape[0] = count;
  auto file_space = space_of_dataset(dataset);
  std::vector<hsize_t> start(shape.size(), 0);
  start[0] = first;
  checked(H5Sselect_hyperslab(*file_space, H5S_SELECT_SET, start.data(), nullptr,
                              sizes(shape).data(), nullptr),
          "rows");
  return {file_space, space_of(shape)};
}

template <class Value>
std::vector<Value> read_all(hid_t dataset, const std::vector<std::size_t>& shape, hid_t memory) {
  const std::size_t count = element_count(shape);
  expect_stored(dataset, count);
  std::vector<Value> values(count);
  if (count > 0) {
    checked(H5Dread(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "reading");
  }
  return values;
}

Handle attribute_for_writing(hid_t object, const std::string& name, hid_t type, hid_t space) {
  if (checked(H5Aexists(object, name.c_str()), name) > 0) {
    checked(H5Adelete(object, name.c_str()), name);
  }
  return handle(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), &H5Aclose,
                "attribute " + name);
}

Handle access_properties() {
  auto access = handle(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose, "access");
  // Format of 1.10: its metadata bear checksums, so damage is noticed.
  checked(H5Pset_libver_bounds(*access, H5F_LIBVER_V110, H5F_LIBVER_V110), "access");
  // Files are written under a name of their own and never changed: locks, which
  // fail on many network file systems, are not needed.
  checked(H5Pset_file_locking(*access, 0, 1), "access");
  checked(H5Pset_fclose_degree(*access, H5F_CLOSE_STRONG), "access");
  return access;
}

}  // namespace

std::string_view kind_words(ValueKind kind) {
  switch (kind) {
    case ValueKind::integer:
      return "whole numbers";
    case ValueKind::real:
      return "numbers";
    case ValueKind::text:
      return "texts of variable length";
    case ValueKind::other:
      break;
  }
  return "values of another kind";
}

void Object::set(const std::string& attribute, const std::string& text) {
  const auto type = text_type();
  const auto target = attribute_for_writing(id(), attribute, *type, *space_of({}));
  const std::string utf8 = utf8_text(text);
  const char* begin = utf8.c_str();
  checked(H5Awrite(*target, *type, &begin), "attribute " + attribute);
}

void Object::set(const std::string& attribute, const std::vector<double>& values, Type type) {
  const auto target =
      attribute_for_writing(id(), attribute, *stored_type(type), *space_of({values.size()}));
  checked(H5Awrite(*target, H5T_NATIVE_DOUBLE, values.data()), "attribute " + attribute);
}

void Object::set(const std::string& attribute, double value, Type type) {
  const auto target = attribute_for_writing(id(), attribute, *stored_type(type), *space_of({}));
  checked(H5Awrite(*target, H5T_NATIVE_DOUBLE, &value), "attribute " + attribute);
}

void Object::set(const std::string& attribute, std::int64_t value) {
  const auto target =
      attribute_for_writing(id(), attribute, *stored_type(Type::int64), *space_of({}));
  checked(H5Awrite(*target, H5T_NATIVE_INT64, &value), "attribute " + attribute);
}

std::optional<std::string> Object::text(const std::string& attribute) const {
  if (checked(H5Aexists(id(), attribute.c_str()), attribute) <= 0) return {};
  const auto source =
      handle(H5Aopen(id(), attribute.c_str(), H5P_DEFAULT), &H5Aclose, "attribute " + attribute);
  const auto type = handle(H5Aget_type(*source), &H5Tclose, "attribute " + attribute);
  const auto space = handle(H5Aget_space(*source), &H5Sclose, "attribute " + attribute);
  if (H5Tis_variable_str(*type) <= 0 || H5Sget_simple_extent_npoints(*space) != 1) return {};
  char* text = nullptr;
  checked(H5Aread(*source, *text_type(), &text), "attribute " + attribute);
  std::string result = utf8_text(text != nullptr ? text : "");
  H5free_memory(text);
  return result;
}

std::optional<std::vector<double>> Object::numbers(const std::string& attribute) const {
  if (checked(H5Aexists(id(), attribute.c_str()), attribute) <= 0) return {};
  const auto source =
      handle(H5Aopen(id(), attribute.c_str(), H5P_DEFAULT), &H5Aclose, "attribute " + attribute);
  const auto type = handle(H5Aget_type(*source), &H5Tclose, "attribute " + attribute);
  const auto space = handle(H5Aget_space(*source), &H5Sclose, "attribute " + attribute);
  const auto kind = H5Tget_class(*type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return {};
  const auto count = static_cast<std::size_t>(
      checked(H5Sget_simple_extent_npoints(*space), "attribute " + attribute));
  if (count * H5Tget_size(*type) > H5Aget_storage_size(*source)) throw Error("data are missing");
  std::vector<double> values(count);
  checked(H5Aread(*source, H5T_NATIVE_DOUBLE, values.data()), "attribute " + attribute);
  return values;
}

std::vector<std::size_t> Dataset::shape() const {
  const auto space = space_of_dataset(id());
  const int rank = checked(H5Sget_simple_extent_ndims(*space), "shape");
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  checked(H5Sget_simple_extent_dims(*space, dims.data(), nullptr), "shape");
  return {dims.begin(), dims.end()};
}

ValueKind Dataset::kind() const {
  const auto type = handle(H5Dget_type(id()), &H5Tclose, "type");
  if (H5Tis_variable_str(*type) > 0) return ValueKind::text;
  const auto kind = H5Tget_class(*type);
  return kind == H5T_INTEGER ? ValueKind::integer
         : kind == H5T_FLOAT ? ValueKind::real
                             : ValueKind::other;
}

void Dataset::write(const std::vector<double>& values) {
  SUNLOAD_EXPECT(values.size() == element_count(shape()), "size of a dataset");
  if (values.empty()) return;
  checked(H5Dwrite(id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "writing");
}

void Dataset::write(const std::vector<std::int32_t>& values) {
  SUNLOAD_EXPECT(values.size() == element_count(shape()), "size of a dataset");
  if (values.empty()) return;
  checked(H5Dwrite(id(), H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "writing");
}

void Dataset::write(const std::vector<std::string>& values) {
  SUNLOAD_EXPECT(values.size() == element_count(shape()), "size of a dataset");
  if (values.empty()) return;
  std::vector<std::string> utf8;
  std::vector<const char*> begins;
  utf8.reserve(values.size());
  begins.reserve(values.size());
  for (const auto& value : values) utf8.push_back(utf8_text(value));
  for (const auto& value : utf8) begins.push_back(value.c_str());
  checked(H5Dwrite(id(), *text_type(), H5S_ALL, H5S_ALL, H5P_DEFAULT, begins.data()), "writing");
}

void Dataset::write_rows(std::size_t first, std::size_t count, const double* values) {
  const auto [file_space, memory_space] = rows_selected(id(), shape(), first, count);
  checked(H5Dwrite(id(), H5T_NATIVE_DOUBLE, *memory_space, *file_space, H5P_DEFAULT, values),
          "writing");
}

void Dataset::write_chunk(const std::vector<std::size_t>& offset,
                          std::span<const unsigned char> bytes, ChunkCoding coding) {
  constexpr std::uint32_t all_filters = 0, skip_shuffle = 0b01;
  checked(H5Dwrite_chunk(id(), H5P_DEFAULT,
                         coding == ChunkCoding::deflated ? all_filters : skip_shuffle,
                         sizes(offset).data(), bytes.size(), bytes.data()),
          "writing");
}

std::vector<double> Dataset::doubles() const {
  return read_all<double>(id(), shape(), H5T_NATIVE_DOUBLE);
}

std::vector<std::int32_t> Dataset::integers() const {
  return read_all<std::int32_t>(id(), shape(), H5T_NATIVE_INT32);
}

std::vector<std::string> Dataset::strings() const {
  const auto size = shape();
  if (!is_text()) throw Error("is not text");
  const auto type = text_type();
  const auto begins = read_all<char*>(id(), size, *type);
  std::vector<std::string> values;
  values.reserve(begins.size());
  // One value is a text with its lines, such as the study; of several each is a name.
  const auto clean = size.empty() ? without_controls : clean_name;
  for (const char* begin : begins) values.push_back(clean(begin != nullptr ? begin : ""));
  auto* reclaimed = const_cast<char**>(begins.data());
  H5Dvlen_reclaim(*type, *space_of(size), H5P_DEFAULT, reclaimed);
  return values;
}

std::vector<double> Dataset::row(std::size_t index) const { return rows(index, 1); }

std::vector<double> Dataset::rows(std::size_t first, std::size_t count) const {
  auto size = shape();
  if (size.empty() || count > size[0] || first > size[0] - count || count == 0)
    throw Error("has no row " + std::to_string(first + count - std::min<std::size_t>(count, 1)));
  const auto [file_space, memory_space] = rows_selected(id(), size, first, count);
  size[0] = count;
  const std::size_t in_all = element_count(size);
  expect_stored(id(), in_all);
  std::vector<double> values(in_all);
  if (values.empty()) return values;
  checked(H5Dread(id(), H5T_NATIVE_DOUBLE, *memory_space, *file_space, H5P_DEFAULT, values.data()),
          "reading");
  return values;
}

void Dataset::make_scale(const std::string& name) {
  checked(H5DSset_scale(id(), name.c_str()), "dimension scale");
}

void Dataset::attach_scale(std::size_t axis, const Dataset& scale) {
  checked(H5DSattach_scale(id(), scale.id(), static_cast<unsigned>(axis)), "dimension scale");
}

File File::create(const std::string& path) {
  set_up_library();
  failed_closing().clear();
  const auto creation = handle(H5Pcreate(H5P_FILE_CREATE), &H5Pclose, "creation");
  // netCDF-4 lists variables in the order of their creation.
  checked(H5Pset_link_creation_order(*creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
          "creation");
  checked(H5Pset_obj_track_times(*creation, false), "creation");
  auto file = handle(H5Fcreate(path.c_str(), H5F_ACC_EXCL, *creation, *access_properties()),
                     &H5Fclose, "creating");
  auto root = handle(H5Gopen2(*file, "/", H5P_DEFAULT), &H5Gclose, "creating");
  return {std::move(file), std::move(root)};
}

File File::open(const std::string& path) {
  set_up_library();
  auto file =
      handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, *access_properties()), &H5Fclose, "opening");
  auto root = handle(H5Gopen2(*file, "/", H5P_DEFAULT), &H5Gclose, "opening");
  return {std::move(file), std::move(root)};
}

Dataset File::create_dataset(const std::string& name, const DatasetSpec& spec) {
  const auto creation = handle(H5Pcreate(H5P_DATASET_CREATE), &H5Pclose, "creation");
  checked(H5Pset_obj_track_times(*creation, false), "creation");
  if (spec.unwritten == DatasetSpec::Unwritten::nan) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    checked(H5Pset_fill_value(*creation, H5T_NATIVE_DOUBLE, &nan), "creation");
  }
  if (!spec.chunk.empty()) {
    checked(H5Pset_chunk(*creation, static_cast<int>(spec.chunk.size()), sizes(spec.chunk).data()),
            "creation");
    checked(H5Pset_shuffle(*creation), "creation");
    checked(H5Pset_deflate(*creation, static_cast<unsigned>(spec.deflate_level)), "creation");
  }
  return Dataset(handle(H5Dcreate2(*file_, name.c_str(), *stored_type(spec.type),
                                   *space_of(spec.shape), H5P_DEFAULT, *creation, H5P_DEFAULT),
                        &H5Dclose, "dataset " + name));
}

bool File::has(const std::string& dataset) const {
  return checked(H5Lexists(id(), dataset.c_str(), H5P_DEFAULT), dataset) > 0;
}

namespace {

/// Bytes of all chunks that hold parts of one row; 0 of what is not in chunks.
std::size_t bytes_of_row_chunks(hid_t dataset, const std::vector<std::size_t>& shape) {
  const auto creation = handle(H5Dget_create_plist(dataset), &H5Pclose, "layout");
  if (shape.empty() || H5Pget_layout(*creation) != H5D_CHUNKED) return 0;
  std::vector<hsize_t> chunk(shape.size());
  checked(H5Pget_chunk(*creation, static_cast<int>(chunk.size()), chunk.data()), "layout");
  const auto type = handle(H5Dget_type(dataset), &H5Tclose, "type");
  std::size_t bytes = H5Tget_size(*type) * chunk[0];
  for (std::size_t d = 1; d < chunk.size(); ++d)
    bytes *= (shape[d] + chunk[d] - 1) / chunk[d] * chunk[d];
  return bytes;
}

}  // namespace

Dataset File::dataset(const std::string& name, Access access) const {
  const auto open = [&](hid_t properties) {
    return handle(H5Dopen2(*file_, name.c_str(), properties), &H5Dclose, "dataset " + name);
  };
  constexpr std::size_t usual = std::size_t{1} << 20, most = std::size_t{1} << 30;
  std::size_t bytes = 0;
  {  // While it is open, another opening has its cache.
    Dataset opened(open(H5P_DEFAULT));
    if (access == Access::rows) bytes = bytes_of_row_chunks(opened.id(), opened.shape());
    if (bytes <= usual || bytes > most) return opened;
  }
  const auto properties = handle(H5Pcreate(H5P_DATASET_ACCESS), &H5Pclose, "access");
  constexpr std::size_t slots = 10'007;  // a prime, ten times the chunks of most rows
  checked(H5Pset_chunk_cache(*properties, slots, bytes, H5D_CHUNK_CACHE_W0_DEFAULT), "access");
  return Dataset(open(*properties));
}

std::vector<std::string> File::names() const {
  std::vector<std::string> list;
  const auto add = [](hid_t, const char* name, const H5L_info_t*, void* names) -> herr_t {
    static_cast<std::vector<std::string>*>(names)->emplace_back(name);
    return 0;
  };
  hsize_t index = 0;
  checked(H5Literate(id(), H5_INDEX_NAME, H5_ITER_NATIVE, &index, add, &list), "listing");
  return list;
}

std::uint64_t File::end() const {
  haddr_t end = 0;
  checked(H5Fget_eoa(*file_, &end), "end");
  return end;
}

void File::close() {
  if (!failed_closing().empty()) throw Error(std::exchange(failed_closing(), {}));
  checked(H5Fflush(*file_, H5F_SCOPE_GLOBAL), "writing");
  handle_.reset();
  // One more reference, so that the closing itself is done, and judged, here.
  const hid_t file = *file_;
  checked(H5Iinc_ref(file), "closing");
  file_.reset();
  checked(H5Fclose(file), "closing");
}

void File::abandon() {
  // Closing would try to write once more what could not be written, which ends in
  // the library's memory (1.10.8): the file stays open as long as the process.
  static auto* const abandoned = new std::vector<Handle>;
  abandoned->push_back(std::move(handle_));
  abandoned->push_back(std::move(file_));
  H5Eclear2(H5E_DEFAULT);
}

}  // namespace sunload::h5
