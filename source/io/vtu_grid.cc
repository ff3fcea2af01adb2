#include <snug/base/assertions.h>
#include <snug/base/narrow.h>
#include <snug/io/vtu_grid.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/utilities.h>

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>
#include <sstream>

namespace snug::io {
namespace {
using Bytes = std::vector<unsigned char>;

/// Size of the blocks of a compressed array in bytes. Readers unpack one block at a time.
const std::size_t block_size = 1 << 20;

template <typename T>
Bytes bytes_of(const std::vector<T> &values)
{
  Bytes result(values.size() * sizeof(T));
  if (!values.empty())
    std::memcpy(result.data(), values.data(), result.size());
  return result;
}

/// Return the Base64 text of the header and then of the blocks. The header contains the number of
/// blocks, their size, the size of the last block if it differs, and the compressed sizes.
template <typename T>
std::string encoded(const std::vector<T> &values, const unsigned int compression)
{
  const Bytes                raw      = bytes_of(values);
  const std::size_t          n_blocks = (raw.size() + block_size - 1) / block_size;
  std::vector<std::uint32_t> header   = {narrow<std::uint32_t>(n_blocks), block_size,
                                         narrow<std::uint32_t>(raw.size() % block_size)};
  Bytes                      blocks;
  for (std::size_t begin = 0; begin < raw.size(); begin += block_size)
    {
      const std::size_t size   = std::min(block_size, raw.size() - begin);
      uLongf            packed = compressBound(size);
      const std::size_t first  = blocks.size();
      blocks.resize(first + packed);
      if (compress2(&blocks[first], &packed, &raw[begin], size, static_cast<int>(compression)) !=
          Z_OK)
        throw std::bad_alloc(); // the only remaining cause of failure
      blocks.resize(first + packed);
      header.push_back(narrow<std::uint32_t>(packed));
    }
  return dealii::Utilities::encode_base64(bytes_of(header)) +
         dealii::Utilities::encode_base64(blocks);
}

/// Return the words common to a piece and the list of files. @param[in] components Names.
std::string declared(const std::string              &type,
                     const std::string              &name,
                     const std::vector<std::string> &components)
{
  std::string text = "DataArray type=\"" + type + "\"";
  if (!name.empty())
    text += " Name=\"" + name + "\"";
  if (components.size() > 1)
    text += " NumberOfComponents=\"" + std::to_string(components.size()) + "\"";
  for (std::size_t c = 0; c < components.size(); ++c)
    text += " ComponentName" + std::to_string(c) + "=\"" + components[c] + "\"";
  return text;
}

/// Return the names of the components of scalars, vectors and symmetric tensors as VTK orders them.
/// VTK knows vectors of three components only.
std::vector<std::string> component_names(const unsigned int components)
{
  return components == 1   ? std::vector<std::string>()
         : components == 6 ? std::vector<std::string>{"XX", "YY", "ZZ", "XY", "YZ", "XZ"}
                           : std::vector<std::string>{"X", "Y", "Z"};
}

std::string opened(const std::string &type)
{
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
         "\" version=\"0.1\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
         "compressor=\"vtkZLibDataCompressor\">\n";
}

/// Return the cell type of VTK: line, quadrilateral, hexahedron.
template <int d>
constexpr std::uint8_t cell_type()
{
  return d == 1 ? 3 : d == 2 ? 9 : 12;
}

/// Return the cell type of VTK: quadratic triangle, quadratic tetrahedron.
template <int d>
constexpr std::uint8_t simplex_type()
{
  return d == 2 ? 22 : 24;
}

/// Return the offsets along the axes of the corners of a cell: around each face, with the upper
/// face after the lower one.
template <int d>
std::vector<std::array<unsigned int, 3>> corner_offsets()
{
  std::vector<std::array<unsigned int, 3>> result = {{{0, 0, 0}}, {{1, 0, 0}}};
  if (d > 1)
    result.insert(result.end(), {{{1, 1, 0}}, {{0, 1, 0}}});
  if (d > 2)
    result.insert(result.end(), {{{0, 0, 1}}, {{1, 0, 1}}, {{1, 1, 1}}, {{0, 1, 1}}});
  return result;
}
} // namespace

template <int d, int dim>
VtuGrid<d, dim>::VtuGrid(const std::vector<Quantity> &of_points,
                         const std::vector<Quantity> &of_the_cells)
  : at_points(arrays(of_points)), of_cells(arrays(of_the_cells))
{}

template <int d, int dim>
std::vector<typename VtuGrid<d, dim>::Array>
VtuGrid<d, dim>::arrays(const std::vector<Quantity> &quantities)
{
  std::vector<Array> result;
  for (const auto &[name, components, names] : quantities)
    result.push_back({name, components, names.empty() ? component_names(components) : names, {}});
  return result;
}

template <int d, int dim>
void VtuGrid<d, dim>::append(const std::vector<double> &values, std::vector<Array> &to)
{
  unsigned int c = 0;
  for (auto &array : to)
    {
      for (unsigned int i = 0; i < array.components; ++i)
        array.values.push_back(static_cast<float>(values[c++]));
      array.values.insert(array.values.end(), array.n_written() - array.components, 0.f);
    }
  SNUG_ASSERT_EQUAL(c, values.size());
}

template <int d, int dim>
unsigned int VtuGrid<d, dim>::add_point(const dealii::Tensor<1, dim> &x,
                                        const std::vector<double>    &values)
{
  for (unsigned int c = 0; c < 3; ++c)
    places.values.push_back(c < dim ? static_cast<float>(x[c]) : 0.f);
  append(values, at_points);
  return narrow<unsigned int>(places.values.size() / 3 - 1);
}

template <int d, int dim>
void VtuGrid<d, dim>::add_cell(const std::vector<unsigned int> &points,
                               const std::vector<double>       &values)
{
  const unsigned int n = std::lround(std::pow(points.size(), 1. / d)); // nodes per edge
  SNUG_ASSERT_EQUAL(dealii::Utilities::fixed_power<d>(n), points.size());
  const unsigned int stride[3] = {1, n, n * n};
  for (unsigned int k = 0; k < (d > 2 ? n - 1 : 1); ++k)
    for (unsigned int j = 0; j < (d > 1 ? n - 1 : 1); ++j)
      for (unsigned int i = 0; i < n - 1; ++i)
        {
          for (const auto &at : corner_offsets<d>())
            corners.push_back(narrow<std::int32_t>(
              points[(i + at[0]) * stride[0] + (j + at[1]) * stride[1] + (k + at[2]) * stride[2]]));
          end_cell(cell_type<d>(), values);
        }
}

template <int d, int dim>
void VtuGrid<d, dim>::add_simplex(const std::vector<unsigned int> &points,
                                  const std::vector<double>       &values)
{
  SNUG_ASSERT_EQUAL(std::size_t((d + 1) * (d + 2) / 2), points.size());
  for (const unsigned int point : points)
    corners.push_back(narrow<std::int32_t>(point));
  end_cell(simplex_type<d>(), values);
}

template <int d, int dim>
void VtuGrid<d, dim>::end_cell(const std::uint8_t type, const std::vector<double> &values)
{
  ends.push_back(narrow<std::int32_t>(corners.size()));
  types.push_back(type);
  append(values, of_cells);
}

template <int d, int dim>
std::string VtuGrid<d, dim>::piece(const unsigned int compression) const
{
  std::ostringstream out;
  const auto         write = [&](const std::string &declaration, const auto &values) {
    out << '<' << declaration << " format=\"binary\">\n"
        << encoded(values, compression) << "\n</DataArray>\n";
  };
  const auto write_all = [&](const std::string &section, const std::vector<Array> &arrays) {
    out << '<' << section << ">\n";
    for (const auto &array : arrays)
      write(declared("Float32", array.name, array.names), array.values);
    out << "</" << section << ">\n";
  };
  out << "<Piece NumberOfPoints=\"" << places.values.size() / 3 << "\" NumberOfCells=\""
      << types.size() << "\">\n";
  write_all("Points", {places});
  out << "<Cells>\n";
  write(declared("Int32", "connectivity", {}), corners);
  write(declared("Int32", "offsets", {}), ends);
  write(declared("UInt8", "types", {}), types);
  out << "</Cells>\n";
  write_all("PointData", at_points);
  write_all("CellData", of_cells);
  out << "</Piece>\n";
  return out.str();
}

/// Return the declarations. They have no values, so any rank can write them.
template <int d, int dim>
std::string VtuGrid<d, dim>::declarations() const
{
  std::ostringstream out;
  const auto         list = [&](const std::string &section, const std::vector<Array> &arrays) {
    out << "<P" << section << ">\n";
    for (const auto &array : arrays)
      out << "<P" << declared("Float32", array.name, array.names) << "/>\n";
    out << "</P" << section << ">\n";
  };
  list("Points", {places});
  list("PointData", at_points);
  list("CellData", of_cells);
  return out.str();
}

std::string pvtu(const std::string &declarations, const std::vector<std::string> &files)
{
  std::string text =
    opened("PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n" + declarations;
  for (const auto &file : files)
    text += "<Piece Source=\"" + file + "\"/>\n";
  return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

std::string vtu_begin()
{
  return opened("UnstructuredGrid") + "<UnstructuredGrid>\n";
}

std::string vtu_end()
{
  return "</UnstructuredGrid>\n</VTKFile>\n";
}

/// Return ParaView's list of time steps; file names are relative to the list.
std::string pvd(const std::vector<std::pair<double, std::string>> &series)
{
  std::ostringstream out;
  dealii::DataOutBase::write_pvd_record(out, series);
  return out.str();
}

template class VtuGrid<1, 2>;
template class VtuGrid<2, 2>;
template class VtuGrid<2, 3>;
template class VtuGrid<3, 3>;
} // namespace snug::io
