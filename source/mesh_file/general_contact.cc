#include <snug/geometry/cell_numbering.h>
#include <snug/mesh_file/deck_sets.h>
#include <snug/mesh_file/element_split.h>
#include <snug/mesh_file/face_gaps.h>

#include <algorithm>
#include <cmath>

namespace snug::mesh_file {
namespace {
using Corners = std::vector<unsigned int>;

/// Return the largest displacement in *BOUNDARY.
double largest_displacement(const DeckText &deck)
{
  double largest = 0.;
  for (const auto &keyword : deck.keywords())
    if (keyword.name == "BOUNDARY")
      deck.for_each_line(keyword, [&](const auto &words, const unsigned long line) {
        if (words.size() > 3 && !words[3].empty())
          largest = std::max(largest, std::abs(to_number(words[3], line)));
      });
  return largest;
}

/// This class finds the pairs of bodies.
class PairFinder
{
public:
  PairFinder(const DeckText &deck, const DeckSets &sets, MeshFile &mesh)
    : mesh(mesh), displacement(largest_displacement(deck)), cells(connected_cells(mesh))
  {
    for (const auto &body : cells)
      {
        std::vector<MeshFile::Element> elements;
        for (const unsigned int element : body.elements)
          elements.push_back(mesh.elements[element]);
        outer.emplace_back();
        for (const auto &face : outer_faces(elements))
          if (sets.cut_faces.count(geometry::sorted(face)) == 0)
            outer.back().push_back(face);
      }
  }

  /// Add the pairs between two surfaces, where "" stands for all outer faces.
  void add(const std::string &first, const std::string &second, const std::size_t begin)
  {
    for (std::size_t a = 0; a < outer.size(); ++a)
      for (std::size_t b = first == second ? a + 1 : 0; b < outer.size(); ++b)
        if (a != b)
          {
            const auto   of = faces_of(a, first), from = faces_of(b, second);
            const double reach =
              displacement + std::max(mean_size(mesh.points, of), mean_size(mesh.points, from));
            const auto there = face_gaps(mesh.points, of, from, reach);
            const auto back  = face_gaps(mesh.points, from, of, reach);
            if (!there.faces.empty() && !back.faces.empty())
              pairs.push_back({boundary(a, b, of, there.faces), boundary(b, a, from, back.faces),
                               begin, std::min(there.least, back.least), reach});
          }
  }

  std::vector<GeneralPair> pairs;

private:
  MeshFile                         &mesh;
  const double                      displacement;
  const std::vector<ConnectedCells> cells;
  std::vector<Faces>                outer; ///< of the bodies

  /// Return the outer faces of a body that belong to a surface.
  Faces faces_of(const std::size_t body, const std::string &surface) const
  {
    std::set<Corners> wanted;
    for (const auto &element : mesh.elements)
      if (std::count(element.groups.begin(), element.groups.end(), surface) > 0)
        wanted.insert(geometry::sorted(element.corners));
    Faces faces;
    for (const auto &face : outer[body])
      if (surface.empty() || wanted.count(geometry::sorted(face)) > 0)
        faces.push_back(face);
    return faces;
  }

  /// Add faces to the optional boundary of a body that touches another one. Return its name.
  std::string boundary(const std::size_t             body,
                       const std::size_t             other,
                       const Faces                  &faces,
                       const std::set<unsigned int> &indices)
  {
    const auto name = cells[body].group + " to " + cells[other].group;
    auto      &to   = mesh.optional_boundaries[name];
    for (const unsigned int face : indices)
      to.faces.push_back({face_shape(faces[face]), faces[face], {}, 0, 0});
    return name;
  }
};
} // namespace

std::vector<GeneralPair> general_pairs(const DeckText &deck, const DeckSets &sets, MeshFile &mesh)
{
  std::vector<GeneralPair> pairs;
  for (const auto &keyword : deck.keywords())
    {
      if (keyword.name != "CONTACTINCLUSIONS")
        continue;
      PairFinder finder(deck, sets, mesh);
      if (keyword.has("ALLEXTERIOR") || keyword.has("ALLELEMENTBASED"))
        finder.add("", "", keyword.begin);
      else
        deck.for_each_line(keyword, [&](const auto &words, const unsigned long line) {
          const auto name = [&](const std::size_t i) -> std::string {
            if (words.size() <= i || words[i].empty())
              return "";
            const auto found = sets.spelling.find(upper_case(words[i]));
            if (found == sets.spelling.end() || sets.surfaces.count(found->second) == 0)
              throw error_at_line(line, "there is no surface '" + words[i] + "'");
            return found->second;
          };
          finder.add(name(0), name(1), keyword.begin);
        });
      pairs.insert(pairs.end(), finder.pairs.begin(), finder.pairs.end());
    }
  return pairs;
}
} // namespace snug::mesh_file
