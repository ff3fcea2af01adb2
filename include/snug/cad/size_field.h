#ifndef snug_cad_size_field_h
#define snug_cad_size_field_h

#include <snug/base/errors.h>
#include <snug/cad/part.h>

#include <deal.II/base/point.h>

#include <map>

namespace snug::cad {
/// A point at which elements have a size.
struct SizeSource
{
  dealii::Point<3> at;
  double           size; ///< [length]
};

/**
 * Return points on the faces of a part at distances of half of the element size of each face. The
 * element size of a face is the entry of @p sizes for its boundary, or half of the minimum radius
 * of curvature of the face (30 degrees), but at least a tenth of @p largest. Faces with sizes of @p
 * largest or more have no points.
 */
std::vector<SizeSource> size_sources(const Part                          &part,
                                     const std::vector<std::string>      &boundaries,
                                     const std::map<std::string, double> &sizes,
                                     double                               largest);

/// Return an element size for a first analysis of a part: the smallest of a radius of curvature of
/// a face, an edge of the box and an eighth of the diagonal of the box, but at least a twentieth of
/// the diagonal.
double suggested_size(const Part &part);

/// The element size h(x) = min(H, min_k (h_k + growth |x - x_k|)).
struct ElementSizes
{
  std::vector<SizeSource> sources;
  double                  largest; ///< H [length]
  double                  growth;

  double at(const dealii::Point<3> &x) const;

  /// Halve the size at @p places, from which it grows to the size before, or everywhere if there
  /// are no places.
  void halve(const std::vector<dealii::Point<3>> &places);
};

/**
 * This class writes element sizes as a background field of Gmsh: the values at the corners of
 * boxes, which are divided until their edges are at most twice as long as the elements.
 */
class SizeField
{
public:
  /// The field covers the box of @p part. @throws InputError @p too_many if the field gives more
  /// than a million elements.
  SizeField(const Part &part, ElementSizes sizes, const InputError &too_many);

  /// Return the field as a view in Gmsh's format .pos.
  const std::string &text() const { return view; }

private:
  using Point = dealii::Point<3>;

  const ElementSizes sizes;
  const InputError   too_many;
  const unsigned int dim;
  double             part_of_box; ///< fraction of the box that the part fills
  double             n_elements = 0.;
  std::string        view;

  void add_box(const Point &lower, const Point &upper, const std::vector<unsigned int> &near);
  void add_leaf(const Point &lower, const Point &upper, const std::vector<unsigned int> &near);
};
} // namespace snug::cad

#endif
