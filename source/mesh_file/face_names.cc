#include <snug/geometry/cell_numbering.h>
#include <snug/mesh_file/element_split.h>
#include <snug/mesh_file/face_names.h>
#include <snug/mesh_file/file_cells.h>

#include <algorithm>

namespace snug::mesh_file {
using geometry::sorted;

FaceNames::FaceNames(const MeshFile                                             &file,
                     const geometry::BodyMeshParameters                         &parameters,
                     const std::vector<Element>                                 &cells,
                     const geometry::NumberByVertices                           &n_cells_of_face,
                     const std::function<std::vector<Corners>(const Element &)> &parts)
  : file(file), parameters(parameters), cells(cells), n_cells_of_face(n_cells_of_face), parts(parts)
{
  const auto        &wanted = parameters.boundary_sets;
  const unsigned int dim    = dimension(cells.front().shape);
  for (const auto &element : file.elements)
    if (dimension(element.shape) == dim - 1 && !element.groups.empty())
      {
        if (wanted.empty())
          name_face(element, name_of(element, element.groups.back()));
        else
          for (const auto &group : element.groups)
            if (is_wanted(group))
              name_face(element, group);
      }
  if (!wanted.empty())
    outer = outer_faces(cells);
  for (const auto &name : wanted)
    name_optional(name);
  for (const auto &name : wanted)
    require_faces(name);
}

std::vector<std::pair<FaceNames::Corners, std::string>> FaceNames::named() const
{
  std::vector<std::pair<Corners, std::string>> result;
  for (const auto &face : order)
    {
      const auto &names = names_of_face.at(face);
      std::string joined;
      for (const auto &set : parameters.boundary_sets)
        if (std::find(names.begin(), names.end(), set) != names.end())
          joined += (joined.empty() ? "" : " and ") + renamed(set);
      if (joined.empty())
        joined = names.front();
      result.emplace_back(face, joined);
    }
  return result;
}

/// Return the name that 'Boundary names' gives to a group. The entry may contain the number of a
/// group without a name.
std::string FaceNames::renamed(const std::string &group) const
{
  const bool is_unnamed = group.rfind(unnamed_group, 0) == 0;
  for (const auto &key : {group, group.substr(is_unnamed ? unnamed_group.size() : 0)})
    if (const auto given = parameters.boundary_numbers.find(key);
        given != parameters.boundary_numbers.end())
      return given->second;
  return group;
}

/// Return the name of the boundary that a group of @p element becomes.
std::string FaceNames::name_of(const Element &element, const std::string &group) const
{
  if (const auto name = renamed(group); name != group)
    return name;
  // These characters separate items in lists of a parameter file.
  if (group.find_first_of(",:;=#\\") != std::string::npos)
    throw element_error(element, "belongs to the group '" + group +
                                   "'; names must not contain , : ; = # or \\");
  return group;
}

bool FaceNames::is_wanted(const std::string &name) const
{
  const auto &wanted = parameters.boundary_sets;
  return std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

/// Name the boundary of a face. A face of several of the 'Boundary sets' belongs to the boundary
/// "A and B"; without the entry, this is an error.
void FaceNames::name_face(const Element &element, const std::string &name)
{
  for (const auto &part : parts(element))
    {
      const Corners key   = sorted(part);
      const auto    found = n_cells_of_face.find(key);
      if (found == n_cells_of_face.end())
        {
          if (parameters.regions.empty())
            throw element_error(element, "is not a face of a cell");
          continue; // a face of another region
        }
      if (found->second == 2)
        continue; // a face between regions
      auto &names = names_of_face[key];
      if (names.empty())
        order.push_back(key);
      if (std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
      if (names.size() > 1 && parameters.boundary_sets.empty())
        throw element_error(element, "belongs to the groups '" + names[0] + "' and '" + names[1] +
                                       "'; 'Boundary sets' lists the groups that are boundaries");
    }
}

/// Name the faces of an optional boundary.
void FaceNames::name_optional(const std::string &name)
{
  const auto found = file.optional_boundaries.find(name);
  if (found == file.optional_boundaries.end())
    return;
  for (const auto &face : found->second.faces)
    name_face(face, name);
  const auto            &nodes = found->second.nodes;
  std::set<unsigned int> used;
  for (const auto &face : outer)
    if (found->second.has_face(file, face))
      {
        name_face({face_shape(face), face, {}, 0, 0}, name);
        used.insert(face.begin(), face.end());
      }
  std::set<unsigned int> of_body;
  for (const auto &cell : cells)
    for (const unsigned int corner : cell.corners)
      if (nodes.count(corner) > 0 && used.count(corner) == 0)
        of_body.insert(corner);
  if (!of_body.empty() && !used.empty())
    notes.push_back(counted(of_body.size(), "node") + " of the set '" + name +
                    "' without a face whose nodes are all in the set");
}

/// Throw unless the boundary set @p name has a face of the body.
void FaceNames::require_faces(const std::string &name) const
{
  for (const auto &[face, names] : names_of_face)
    if (std::find(names.begin(), names.end(), name) != names.end())
      return;
  std::set<std::string> known;
  for (const auto &element : file.elements)
    if (dimension(element.shape) + 1 == dimension(cells.front().shape))
      known.insert(element.groups.begin(), element.groups.end());
  for (const auto &optional : file.optional_boundaries)
    known.insert(optional.first);
  throw bad_entry("Boundary sets", to_text(parameters.boundary_sets),
                  known.count(name) > 0
                    ? "'" + name + "' has no face of the body whose nodes are all in the set"
                    : "'" + name + "' is not a set of faces or nodes of the file; the sets are " +
                        to_text(std::vector<std::string>(known.begin(), known.end())));
}
} // namespace snug::mesh_file
