#ifndef snug_deck_deck_model_h
#define snug_deck_deck_model_h

#include <snug/deck/deck_bodies.h>
#include <snug/deck/left_out.h>

#include <optional>

namespace snug::deck {
/// The materials, supports, loads and contacts of a deck. Sets are named as in DeckBodies, and have
/// been used there.
struct DeckModel
{
  struct Material
  {
    std::string           name;
    unsigned long         line;
    std::optional<double> youngs_modulus, poissons_ratio;
    double                density = 0.;
  };

  /// A displacement component of a set [length].
  struct PrescribedComponent
  {
    std::string   set;
    unsigned int  component;
    double        value;
    unsigned long line;
  };

  /// A pressure (one component) or a traction on a set.
  struct FaceLoad
  {
    std::string         set;
    std::vector<double> components;
    unsigned long       line;
  };

  /// The sum of the forces at a node [force].
  struct PointForce
  {
    std::vector<double>        components;
    std::vector<unsigned long> lines;
  };

  /// Gravity of the elements of a set.
  struct Gravity
  {
    std::set<unsigned int> elements;
    std::vector<double>    acceleration;
    unsigned long          line;
  };

  struct Contact
  {
    std::string   slave, master, interaction;
    unsigned long line;
  };

  std::vector<Material>               materials;
  std::map<unsigned int, std::string> material_of; ///< element -> material
  std::map<unsigned int, std::string> region_of;   ///< element -> set of its section
  std::vector<PrescribedComponent>    prescribed;
  std::vector<FaceLoad>               pressures, tractions;
  std::map<unsigned int, PointForce>  point_forces; ///< by node
  std::vector<Gravity>                gravities;
  std::vector<Contact>                contacts;
  std::map<std::string, double>       friction; ///< interaction in upper case -> coefficient
  std::optional<double>               thickness;
  std::string                         model = "solid";
};

/// Read the keywords of a deck. Keywords and options that are not read are added to @p left_out.
/// @throws InputError "line 17: message".
DeckModel read_model(const mesh_file::DeckText &text,
                     const mesh_file::DeckMesh &deck,
                     DeckBodies                &bodies,
                     LeftOut                   &left_out);
} // namespace snug::deck

#endif
