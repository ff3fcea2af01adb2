#include <snug/geometry/boundary_formulas.h>
#include <snug/geometry/cell_numbering.h>
#include <snug/geometry/entry_values.h>
#include <snug/geometry/formula.h>
#include <snug/geometry/wrapped_geometry.h>

#include <deal.II/base/geometry_info.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace snug::geometry {
namespace {
const std::string entry = "Boundary formulas";

/// Part of the way from a vertex to the centre of its face at which formulas are evaluated.
const double inside = 1e-9;

/// Maximum number of equal parts of an edge that are proposed.
const unsigned int most_parts = 20;

/// Number of bisections of an edge to find where a formula changes its sign.
const unsigned int n_bisections = 40;

/// A boundary that consists of faces of another one.
template <int dim>
struct NewBoundary
{
  std::string  text; ///< as in the entry
  unsigned int of;   ///< index of the other boundary
  Formula<dim> formula;
};

/// The faces of a boundary that a formula cuts.
template <int dim>
struct CutFaces
{
  unsigned int       n = 0;
  dealii::Point<dim> place;       ///< where the formula changes its sign on the first one
  double             length = 0.; ///< of the edge there
  /// part of the edge up to the place; not a number on a diagonal of the face
  double part = std::numeric_limits<double>::quiet_NaN();

  /// Return the size of cells that divides the edge at the place, or 0 if no small number of equal
  /// cells does.
  double fitting_size() const
  {
    for (unsigned int n = 2; n <= most_parts; ++n)
      if (std::abs(n * part - std::round(n * part)) < 1e-6 * n)
        return length / n;
    return 0.;
  }
};

/// Return the boundary before the formula.
std::string divided(const std::string &text)
{
  return trim(text.substr(0, text.find('&')));
}

template <int dim>
NewBoundary<dim>
parsed(const std::string &name, const std::string &text, const std::vector<std::string> &names)
{
  const auto        end   = text.find('&');
  const std::string value = name + ": " + text;
  if (end == std::string::npos)
    throw bad_entry(entry, value, "must be 'name: boundary & FORMULA'");
  const unsigned int index = index_of(names, divided(text));
  if (index == names.size())
    throw bad_entry(entry, value, "must name one of the boundaries " + to_text(names));
  return {value, index, Formula<dim>(entry, text.substr(end + 1))};
}

/// A geometry whose coarse faces have the new boundaries.
template <int dim>
class GeometryWithBoundaries : public WrappedGeometry<dim>
{
public:
  using CoarseMesh = typename BodyGeometry<dim>::CoarseMesh;

  GeometryWithBoundaries(std::unique_ptr<BodyGeometry<dim>> geometry,
                         const BodyMeshParameters          &parameters)
    : WrappedGeometry<dim>(std::move(geometry)), names(this->body->boundary_names())
  {
    const auto own = names;
    for (const auto &[name, text] : parameters.boundary_formulas)
      {
        if (index_of(names, name) < names.size())
          throw bad_entry(entry, name + ": " + text, "must have a name that no boundary has");
        added.push_back(parsed<dim>(name, text, own));
        names.push_back(name);
      }
    if (this->has_all_cells())
      check();
  }

  CoarseMesh coarse_mesh() const override
  {
    auto                       mesh = this->body->coarse_mesh();
    std::vector<CutFaces<dim>> cut(added.size());
    auto                       face = mesh.boundary_faces.begin();
    for_faces(mesh, [&](const unsigned int boundary, const Corners &corners) {
      (face++)->second = boundary_of(boundary, corners, cut);
    });
    return mesh;
  }

  unsigned int side_boundary(const unsigned int coarse_cell, const unsigned int face) const override
  {
    std::vector<CutFaces<dim>> cut(added.size());
    return boundary_of(this->body->side_boundary(coarse_cell, face), side(coarse_cell, face), cut);
  }

  const std::vector<std::string> &boundary_names() const override { return names; }

  BoundaryShape boundary_shape(const unsigned int boundary) const override
  {
    const unsigned int n = names.size() - added.size();
    return this->body->boundary_shape(boundary < n ? boundary : added[boundary - n].of);
  }

  bool is_box_side(const unsigned int boundary) const override
  {
    return boundary < names.size() - added.size() && this->body->is_box_side(boundary) &&
           std::none_of(
             added.begin(), added.end(),
             [boundary](const auto &part) { return part.of == boundary; });
  }

private:
  using Corners = std::vector<dealii::Point<dim>>;

  std::vector<std::string>      names;
  std::vector<NewBoundary<dim>> added;

  /// Return the corners of a face of a grid.
  Corners side(const unsigned int cell, const unsigned int face) const
  {
    Vertices vertices(dealii::GeometryInfo<dim>::vertices_per_cell);
    std::iota(vertices.begin(), vertices.end(), 0u);
    Corners corners;
    for (const unsigned int v : face_of<dim>(vertices, face))
      corners.push_back(
        this->body->position({cell, dealii::GeometryInfo<dim>::unit_cell_vertex(v)}));
    return corners;
  }

  /// Call @p action with the boundary before the formulas and the corners of each boundary face.
  template <typename Action>
  void for_faces(const CoarseMesh &mesh, const Action &action) const
  {
    // Vertices of the coarse mesh need not lie at their positions.
    std::vector<MeshPoint<dim>> places(mesh.vertices.size());
    for (unsigned int cell = 0; cell < mesh.cells.size(); ++cell)
      for (unsigned int v = 0; v < mesh.cells[cell].size(); ++v)
        places[mesh.cells[cell][v]] = {cell, dealii::GeometryInfo<dim>::unit_cell_vertex(v)};
    for (const auto &[vertices, boundary] : mesh.boundary_faces)
      {
        Corners corners;
        for (const unsigned int vertex : vertices)
          corners.push_back(this->body->position(places[vertex]));
        action(boundary, corners);
      }
  }

  /// Return the boundary of a face that has the boundary @p own before the formulas.
  unsigned int
  boundary_of(const unsigned int own, const Corners &corners, std::vector<CutFaces<dim>> &cut) const
  {
    for (unsigned int k = 0; k < added.size(); ++k)
      if (added[k].of == own && contains(added[k].formula, corners, cut[k]))
        return names.size() - added.size() + k;
    return own;
  }

  /// Check that each new boundary has faces and cuts none. A grid needs no coarse mesh for this.
  void check() const
  {
    std::vector<unsigned int>  n_faces(names.size(), 0);
    std::vector<CutFaces<dim>> cut(added.size());
    const auto                 add = [&](const unsigned int boundary, const Corners &corners) {
      ++n_faces[boundary_of(boundary, corners, cut)];
    };
    if (const auto *grid = this->grid())
      grid->for_sides([&](const unsigned int cell, const unsigned int face) {
        add(this->body->side_boundary(cell, face), side(cell, face));
      });
    else
      for_faces(this->body->coarse_mesh(), add);
    for (unsigned int k = 0; k < added.size(); ++k)
      check(added[k].text, n_faces[names.size() - added.size() + k], cut[k]);
  }

  /// Return whether the formula is positive at all corners of a face, and count it in @p cut if it
  /// is positive at some.
  static bool contains(const Formula<dim> &formula, const Corners &corners, CutFaces<dim> &cut)
  {
    dealii::Point<dim> centre;
    for (const auto &corner : corners)
      centre += corner / double(corners.size());
    Corners           places;
    std::vector<bool> positive;
    for (const auto &corner : corners)
      {
        places.push_back(corner + inside * (centre - corner));
        positive.push_back(formula.value(places.back()) > 0.);
      }
    const auto n = std::count(positive.begin(), positive.end(), true);
    if (n > 0 && n < std::ptrdiff_t(corners.size()) && cut.n++ == 0)
      {
        // Some edge of the face, or its diagonal, has both signs.
        const auto         first = std::find(positive.begin(), positive.end(), true);
        const auto         last  = std::find(positive.begin(), positive.end(), false);
        dealii::Point<dim> in    = places[first - positive.begin()],
                           out   = places[last - positive.begin()];
        cut.length               = in.distance(out);
        for (unsigned int i = 0; i < n_bisections; ++i)
          {
            const dealii::Point<dim> middle         = in + 0.5 * (out - in);
            (formula.value(middle) > 0. ? in : out) = middle;
          }
        cut.place = in;
        // Corners 0 and 3, and 1 and 2, are opposite to each other.
        const bool is_diagonal =
          dim == 3 && first - positive.begin() + (last - positive.begin()) == 3;
        if (!is_diagonal)
          cut.part = in.distance(places[first - positive.begin()]) / cut.length;
      }
    return n == std::ptrdiff_t(corners.size());
  }

  static void check(const std::string &value, const unsigned int n_faces, const CutFaces<dim> &cut)
  {
    std::ostringstream text;
    const double       size = cut.fitting_size();
    if (cut.n > 0)
      text << "must follow the edges of faces, but cuts " << counted(cut.n, "face")
           << ", the first at (" << cut.place << "), on an edge of the length " << cut.length;
    if (size > 0.)
      text << "; cells of the size " << size << " have nodes there";
    else if (cut.n > 0)
      text << "; move the nodes there by the numbers or sizes of cells";
    else if (n_faces == 0)
      text << "must be positive on a face of the mesh before refinement";
    if (!text.str().empty())
      throw bad_entry(entry, value, text.str());
  }
};
} // namespace

template <int dim>
std::unique_ptr<BodyGeometry<dim>>
with_boundary_formulas(std::unique_ptr<BodyGeometry<dim>> geometry,
                       const BodyMeshParameters          &parameters)
{
  if (parameters.boundary_formulas.empty())
    return geometry;
  return std::make_unique<GeometryWithBoundaries<dim>>(std::move(geometry), parameters);
}

bool is_part(const BodyMeshParameters &parameters, const std::string &boundary)
{
  const auto &formulas = parameters.boundary_formulas;
  return std::any_of(formulas.begin(), formulas.end(), [&](const auto &formula) {
    return formula.first == boundary || divided(formula.second) == boundary;
  });
}

template std::unique_ptr<BodyGeometry<2>> with_boundary_formulas(std::unique_ptr<BodyGeometry<2>>,
                                                                 const BodyMeshParameters &);
template std::unique_ptr<BodyGeometry<3>> with_boundary_formulas(std::unique_ptr<BodyGeometry<3>>,
                                                                 const BodyMeshParameters &);
} // namespace snug::geometry
