#ifndef snug_contact_pair_h
#define snug_contact_pair_h

#include <snug/contact/obstacle.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace snug {
class Entries;
class SectionCheck;
} // namespace snug

namespace snug::contact {
/// How two faces meet.
enum class Method
{
  nodal,
  mortar
};
inline Names names(Method)
{
  return {{"nodal",
           "slave nodes against the closest points of master faces; beyond the end of the master "
           "side forces fade, to zero at 5 % of a face"},
          {"mortar",
           "mean gaps around slave nodes, integrated over both faces: for meshes that do not "
           "match"}};
}

enum class Slave
{
  finer, ///< the side of the smaller faces, of mortar rows where they differ that of the larger
  first  ///< the side that is named first
};
inline Names names(Slave)
{
  return {{"finer"}, {"first"}};
}

/// How two sides meet: entries of `subsection Contact`, for all pairs, and
/// of `subsection Pair SLAVE: MASTER`.
struct PairParameters
{
  std::optional<Method> method; ///< none: by whether the meshes match
  Slave                 slave = Slave::finer;
  /// slave nodes farther from the master carry no row [length]; 0: any
  double search_distance = 0.;
  /// between the slave's normal and the row's [degrees]
  double      largest_angle = 90.;
  std::string gap           = "0";   ///< added to gaps, of x, y, z [length]
  bool        interference  = false; ///< initial overlap is wanted

  void declare(Entries &entries);
  void check(const SectionCheck &section) const;
};

/// The faces that the side of a pair names: "body.boundary + body.boundary" has two.
std::vector<std::string> faces_of_side(const std::string &side);

/// Entries of `subsection Contact`.
struct ContactParameters
{
  struct Entry
  {
    std::string    slave;  ///< body.boundary + ...
    std::string    master; ///< body.boundary + ..., or an obstacle
    PairParameters parameters;

    std::string section() const { return "Pair " + slave + ": " + master; }

    void declare(Entries &entries) { parameters.declare(entries); }
  };

  PairParameters     defaults;
  std::vector<Entry> pairs;
  /// how often an optimization goes on with contact paired anew
  unsigned int update_pairing = 0;

  void declare(Entries &entries);
};

/// Body and boundary.
using Boundary = std::pair<unsigned int, unsigned int>;

/// One side of a pair: one or several boundaries of a body.
class Side
{
public:
  Side() = default;
  Side(unsigned int body, unsigned int boundary) : members({{body, boundary}}) {}
  Side(const Boundary &boundary) : members({boundary}) {}

  /// Ascending.
  const std::vector<Boundary> &boundaries() const { return members; }
  /// Of a side that has a boundary.
  unsigned int body() const { return members.front().first; }
  void         add(const Boundary &boundary);
  bool         has(const Boundary &boundary) const;

private:
  std::vector<Boundary> members;
};

/// Whether a face of a mesh or of a surface lies on @p side.
template <typename Face>
bool is_on(const Face &face, const Side &side)
{
  return side.has({face.body, face.boundary});
}

/// One contact pair: a slave side and a master side or obstacle.
struct Pair
{
  Side                              slave, master;
  std::string                       slave_name = {}, master_name = {};
  PairParameters                    parameters = {};
  std::optional<ObstacleParameters> obstacle   = {};
  /// the larger of Young's moduli of the two bodies, of their softest materials, over the other
  double contrast = 1.;

  /// "slave: master"
  std::string name() const { return slave_name + ": " + master_name; }
};

/// Of all sides of @p pairs, ascending.
std::vector<Boundary> boundaries_of(const std::vector<Pair> &pairs);
} // namespace snug::contact

#endif
