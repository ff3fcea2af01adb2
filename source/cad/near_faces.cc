#include <snug/cad/face_samples.h>
#include <snug/cad/near_faces.h>
#include <snug/cad/surface_projection.h>

#include <BRepBndLib.hxx>
#include <BRepGProp.hxx>
#include <BRepTools.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <ElCLib.hxx>
#include <GProp_GProps.hxx>
#include <TopoDS.hxx>

#include <cmath>

namespace snug::cad {
namespace {
/// A face with samples, and the projection on it.
class SampledFace
{
public:
  /// A point of the face.
  struct Place
  {
    gp_Pnt at;
    gp_Vec normal; ///< unit normal out of the part
  };

  explicit SampledFace(const TopoDS_Face &face)
    : surface(BRep_Tool::Surface(face))
    , projection(face)
    , border(face)
    , sign(face.Orientation() == TopAbs_REVERSED ? -1. : 1.)
  {
    BRepTools::UVBounds(face, first[0], last[0], first[1], last[1]);
    BRepBndLib::Add(face, box);
    GProp_GProps properties;
    BRepGProp::SurfaceProperties(face, properties);
    area                       = properties.Mass();
    const double       mean[2] = {0.5 * (first[0] + last[0]), 0.5 * (first[1] + last[1])};
    const unsigned int n       = 24;
    // The samples are moved away from the edges, so that faces that have only edges in common are
    // not near.
    for (const auto &at : samples_inside(face, n, n))
      if (const auto place =
            place_at({mean[0] + 0.999 * (at.X() - mean[0]), mean[1] + 0.999 * (at.Y() - mean[1])}))
        samples.push_back(*place);
  }

  /// Return the projection of a point on the face, or nothing if it is outside of the edges.
  std::optional<Place> project(const gp_Pnt &x) const
  {
    gp_Pnt2d at = projection.parameters(x);
    if (surface->IsUPeriodic())
      at.SetX(ElCLib::InPeriod(at.X(), first[0], first[0] + surface->UPeriod()));
    if (surface->IsVPeriodic())
      at.SetY(ElCLib::InPeriod(at.Y(), first[1], first[1] + surface->VPeriod()));
    if (!border.encloses(at.Y(), border.crossings(at.X())))
      return {};
    return place_at(at);
  }

  std::vector<Place> samples;
  Bnd_Box            box;
  double             area;

private:
  Handle(Geom_Surface) surface;
  SurfaceProjection     projection;
  FaceBorder            border;
  double                sign; ///< of the outward normal with respect to S_u x S_v
  std::array<double, 2> first, last;

  std::optional<Place> place_at(const gp_Pnt2d &at) const
  {
    gp_Pnt on;
    gp_Vec u, v;
    surface->D1(at.X(), at.Y(), on, u, v);
    const gp_Vec normal = sign * (u ^ v);
    if (!(normal.Magnitude() > 0.))
      return {}; // a pole
    return Place{on, normal.Normalized()};
  }
};

/// The distance from the face a to the face b.
struct Distance
{
  unsigned int n_near = 0; ///< samples of a that are near b
  double       gap    = HUGE_VAL;

  Distance(const SampledFace &a, const SampledFace &b, const double limit)
  {
    std::optional<SampledFace::Place> closest; // on b
    double                            least = HUGE_VAL;
    for (const auto &place : a.samples)
      {
        const auto opposite = b.project(place.at);
        const auto own_gap  = opposite ? gap_between(place, *opposite) : std::nullopt;
        if (!own_gap)
          continue;
        if (std::abs(*own_gap) < least)
          {
            least   = std::abs(*own_gap);
            closest = opposite;
          }
        if (std::abs(*own_gap) <= limit)
          {
            ++n_near;
            gap = std::min(gap, *own_gap);
          }
      }
    if (n_near == 0 && closest)
      search(a, b, *closest, limit);
  }

private:
  /// Return the gap along the normal of a; nothing if the normals are not opposite.
  static std::optional<double> gap_between(const SampledFace::Place &a, const SampledFace::Place &b)
  {
    return a.normal * b.normal < -std::sqrt(0.5)
             ? std::optional<double>(gp_Vec(a.at, b.at) * a.normal)
             : std::nullopt;
  }

  /// Project the point of b closest to a sample on a and b in turn, because faces that touch at a
  /// point or along a line have no near samples.
  void
  search(const SampledFace &a, const SampledFace &b, SampledFace::Place on_b, const double limit)
  {
    for (unsigned int turn = 0; turn < 50; ++turn)
      {
        const auto on_a = a.project(on_b.at);
        const auto next = on_a ? b.project(on_a->at) : std::nullopt;
        const auto own  = next ? gap_between(*on_a, *next) : std::nullopt;
        if (!own)
          return;
        on_b = *next;
        if (turn > 0 && std::abs(*own) <= limit)
          gap = std::min(gap, *own);
      }
  }
};

/// Return the faces as near faces, without the numbers of their parts, or nothing if they are not
/// near.
std::optional<NearFaces> near(const SampledFace &a, const SampledFace &b, const double limit)
{
  Bnd_Box box = a.box;
  box.Enlarge(limit);
  if (box.IsOut(b.box))
    return {};
  const Distance to_b(a, b, limit), to_a(b, a, limit);
  NearFaces      result;
  result.gap = std::min(to_b.gap, to_a.gap);
  if (result.gap == HUGE_VAL)
    return {};
  // The smaller face has the finer samples.
  const auto [face, n_near] =
    a.area < b.area ? std::make_pair(&a, to_b.n_near) : std::make_pair(&b, to_a.n_near);
  result.area = face->area * n_near / std::max<std::size_t>(1, face->samples.size());
  return result;
}
} // namespace

std::vector<NearFaces> near_faces(const std::vector<Part> &parts)
{
  std::vector<std::vector<SampledFace>> faces(parts.size());
  for (unsigned int p = 0; p < parts.size(); ++p)
    for (const auto &face : parts[p].faces())
      faces[p].emplace_back(TopoDS::Face(face));
  std::vector<NearFaces> result;
  for (unsigned int p = 0; p < parts.size(); ++p)
    for (unsigned int q = p + 1; q < parts.size(); ++q)
      for (unsigned int f = 0; f < faces[p].size(); ++f)
        for (unsigned int g = 0; g < faces[q].size(); ++g)
          if (auto found = near(faces[p][f], faces[q][g], near_limit(parts[p], parts[q])))
            {
              found->parts = {{p, q}};
              found->faces = {{f, g}};
              result.push_back(*found);
            }
  return result;
}

double near_limit(const Part &a, const Part &b)
{
  return 0.01 * std::min(a.size, b.size);
}
} // namespace snug::cad
