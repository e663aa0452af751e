// SPDX-FileCopyrightText: The sunload authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/result_change.h"

#include <hdf5.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace sunload::test {
namespace {

template <class Result>
Result checked(Result result, const std::string& what) {
  if (result < 0) throw std::runtime_error("HDF5 does not change " + what);
  return result;
}

/// An identifier of the library, given back at the end.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t), const std::string& what)
      : id_(checked(id, what)), close_(close) {}
  ~Id() { close_(id_); }
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

std::size_t count_of(const std::vector<std::size_t>& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

std::vector<std::size_t> shape_of(hid_t space) {
  std::vector<hsize_t> dims(
      static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, dims.data(), nullptr);
  return {dims.begin(), dims.end()};
}

Id text_type() {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return Id(type, &H5Tclose, "text");
}

Id space_of(const std::vector<std::size_t>& shape) {
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  return Id(shape.empty() ? H5Screate(H5S_SCALAR)
                          : H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
            &H5Sclose, "a shape");
}

/// Whether values of the type are numbers or texts, and which: what HDF5 keeps for itself is
/// neither.
bool is_ours(hid_t type, bool& is_text) {
  is_text = H5Tis_variable_str(type) > 0;
  const auto kind = H5Tget_class(type);
  return is_text || kind == H5T_INTEGER || kind == H5T_FLOAT;
}

/// The object that a place is of, and its values read and written through one face.
class Values {
 public:
  Values(hid_t file, const ResultPlace& place)
      : name_(place.dataset + "." + place.attribute),
        object_(place.dataset.empty() ? H5Gopen2(file, "/", H5P_DEFAULT)
                                      : H5Dopen2(file, place.dataset.c_str(), H5P_DEFAULT),
                place.dataset.empty() ? &H5Gclose : &H5Dclose, name_),
        attribute_(
            place.attribute.empty()
                ? nullptr
                : std::make_unique<Id>(H5Aopen(object_, place.attribute.c_str(), H5P_DEFAULT),
                                       &H5Aclose, name_)),
        count_(count_of(place.shape)) {}

  std::vector<double> numbers() const {
    std::vector<double> values(count_);
    if (count_ > 0) read(H5T_NATIVE_DOUBLE, values.data());
    return values;
  }
  void write(const std::vector<double>& values) const {
    if (count_ > 0) write(H5T_NATIVE_DOUBLE, values.data());
  }
  std::vector<std::string> texts() const {
    std::vector<char*> begins(count_, nullptr);
    const Id type = text_type();
    if (count_ > 0) read(type, begins.data());
    std::vector<std::string> values;
    for (char* begin : begins) {
      values.emplace_back(begin != nullptr ? begin : "");
      H5free_memory(begin);
    }
    return values;
  }
  void write(const std::vector<std::string>& values) const {
    std::vector<const char*> begins;
    for (const auto& value : values) begins.push_back(value.c_str());
    if (count_ > 0) write(text_type(), begins.data());
  }

 private:
  void read(hid_t type, void* to) const {
    checked(attribute_ ? H5Aread(*attribute_, type, to)
                       : H5Dread(object_, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, to),
            name_);
  }
  void write(hid_t type, const void* from) const {
    checked(attribute_ ? H5Awrite(*attribute_, type, from)
                       : H5Dwrite(object_, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, from),
            name_);
  }

  std::string name_;
  Id object_;
  std::unique_ptr<Id> attribute_;
  std::size_t count_;
};

void add_place(std::vector<ResultPlace>& places, hid_t type, hid_t space, std::string dataset,
               std::string attribute) {
  ResultPlace place{std::move(dataset), std::move(attribute), shape_of(space), false};
  if (is_ours(type, place.is_text)) places.push_back(std::move(place));
}

struct Listing {
  std::vector<ResultPlace> places;
  std::string dataset;
};

herr_t list_attribute(hid_t object, const char* name, const H5A_info_t*, void* to) {
  auto& listing = *static_cast<Listing*>(to);
  const Id attribute(H5Aopen(object, name, H5P_DEFAULT), &H5Aclose, name);
  const Id type(H5Aget_type(attribute), &H5Tclose, name);
  const Id space(H5Aget_space(attribute), &H5Sclose, name);
  add_place(listing.places, type, space, listing.dataset, name);
  return 0;
}

void list_attributes(hid_t object, Listing& listing) {
  hsize_t from = 0;
  checked(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, &from, &list_attribute, &listing),
          "attributes");
}

herr_t list_dataset(hid_t root, const char* name, const H5L_info_t*, void* to) {
  auto& listing = *static_cast<Listing*>(to);
  const Id dataset(H5Dopen2(root, name, H5P_DEFAULT), &H5Dclose, name);
  const Id type(H5Dget_type(dataset), &H5Tclose, name);
  const Id space(H5Dget_space(dataset), &H5Sclose, name);
  add_place(listing.places, type, space, name, "");
  listing.dataset = name;
  list_attributes(dataset, listing);
  return 0;
}

hid_t opened(const std::string& path, unsigned access) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Id properties(H5Pcreate(H5P_FILE_ACCESS), &H5Pclose, path);
  H5Pset_libver_bounds(properties, H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5Pset_fclose_degree(properties, H5F_CLOSE_STRONG);
  return checked(H5Fopen(path.c_str(), access, properties), path);
}

/// Makes a dataset anew, with its unit; other attributes are lost.
void replace(hid_t file, const ResultPlace& place, hid_t type,
             const std::vector<std::size_t>& shape) {
  const ResultPlace unit_place{place.dataset, "units", {}, true};
  std::vector<std::string> units;
  {
    const Id old(H5Dopen2(file, place.dataset.c_str(), H5P_DEFAULT), &H5Dclose, place.dataset);
    if (H5Aexists(old, "units") > 0) units = Values(file, unit_place).texts();
  }
  checked(H5Ldelete(file, place.dataset.c_str(), H5P_DEFAULT), place.dataset);
  const Id made(H5Dcreate2(file, place.dataset.c_str(), type, space_of(shape), H5P_DEFAULT,
                           H5P_DEFAULT, H5P_DEFAULT),
                &H5Dclose, place.dataset);
  if (units.empty()) return;
  {
    const Id attribute(
        H5Acreate2(made, "units", text_type(), space_of({}), H5P_DEFAULT, H5P_DEFAULT), &H5Aclose,
        "units");
  }
  Values(file, unit_place).write(units);
}

}  // namespace

std::vector<ResultPlace> places_of(const std::string& path) {
  const Id file(opened(path, H5F_ACC_RDONLY), &H5Fclose, path);
  Listing listing;
  const Id root(H5Gopen2(file, "/", H5P_DEFAULT), &H5Gclose, path);
  list_attributes(root, listing);
  hsize_t from = 0;
  checked(H5Literate(root, H5_INDEX_NAME, H5_ITER_INC, &from, &list_dataset, &listing), path);
  return listing.places;
}

ChangedResult::ChangedResult(const std::string& path) : file_(opened(path, H5F_ACC_RDWR)) {}
ChangedResult::~ChangedResult() { H5Fclose(file_); }

void ChangedResult::set(const ResultPlace& place, double value, std::size_t index) const {
  const Values values(file_, place);
  auto numbers = values.numbers();
  if (numbers.empty()) return;
  numbers[index % numbers.size()] = value;
  values.write(numbers);
}

void ChangedResult::set(const ResultPlace& place, double value) const {
  Values(file_, place).write(std::vector<double>(count_of(place.shape), value));
}

void ChangedResult::set(const ResultPlace& place, const std::string& text,
                        std::size_t index) const {
  const Values values(file_, place);
  auto texts = values.texts();
  if (texts.empty()) return;
  texts[index % texts.size()] = text;
  values.write(texts);
}

void ChangedResult::set(const ResultPlace& place, const std::string& text) const {
  Values(file_, place).write(std::vector<std::string>(count_of(place.shape), text));
}

void ChangedResult::reshape(const ResultPlace& place, const std::vector<std::size_t>& shape) const {
  ResultPlace changed = place;
  changed.shape = shape;
  if (place.is_text) {
    auto texts = Values(file_, place).texts();
    texts.resize(count_of(shape));
    replace(file_, place, text_type(), shape);
    Values(file_, changed).write(texts);
    return;
  }
  auto numbers = Values(file_, place).numbers();
  numbers.resize(count_of(shape));
  const Id old(H5Dopen2(file_, place.dataset.c_str(), H5P_DEFAULT), &H5Dclose, place.dataset);
  const Id type(H5Dget_type(old), &H5Tclose, place.dataset);
  replace(file_, place, type, shape);
  Values(file_, changed).write(numbers);
}

void ChangedResult::retype(const ResultPlace& place) const {
  if (place.is_text) {
    replace(file_, place, H5T_IEEE_F64LE, place.shape);
    return set(place, 1.0);
  }
  replace(file_, place, text_type(), place.shape);
  set(place, std::string("text"));
}

void ChangedResult::remove(const ResultPlace& place) const {
  if (place.attribute.empty()) {
    checked(H5Ldelete(file_, place.dataset.c_str(), H5P_DEFAULT), place.dataset);
    return;
  }
  const std::string object = place.dataset.empty() ? "/" : place.dataset;
  checked(H5Adelete_by_name(file_, object.c_str(), place.attribute.c_str(), H5P_DEFAULT), object);
}

void change_number(const std::string& path, const std::string& dataset, std::size_t index,
                   double value) {
  const auto places = places_of(path);
  const auto place = std::find_if(places.begin(), places.end(), [&](const ResultPlace& p) {
    return p.dataset == dataset && p.attribute.empty();
  });
  if (place == places.end()) throw std::runtime_error("no dataset " + dataset + " in " + path);
  ChangedResult(path).set(*place, value, index);
}

}  // namespace sunload::test
