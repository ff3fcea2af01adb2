#include <snug/base/values.h>
#include <snug/deck/keyword_reader.h>
#include <snug/mesh_file/face_gaps.h>

#include <algorithm>
#include <memory>

namespace snug::deck {
using mesh_file::error_at_line;
using mesh_file::Keyword;
using mesh_file::keyword_error;
using mesh_file::to_number;
using mesh_file::upper_case;
using Words = std::vector<std::string>;

namespace {
/// Gaps below this fraction of a face are those of rounded positions.
const double closed_gap = 0.01;

/// Default of POSITION TOLERANCE in mean sizes of master faces, as in Abaqus. CalculiX has 2.5 %.
const double tie_tolerance = 0.05;

/// This class reads the contacts with their friction, and the ties.
class ContactReader
{
public:
  explicit ContactReader(Reading &reading) : reading(reading), model(reading.model) {}

  void read_interaction(const Keyword &keyword)
  {
    if (keyword.option("NAME").empty())
      throw keyword_error(keyword, keyword.title + " has no NAME");
    unsigned int n_lines = 0; // Abaqus has one line with the width of plane models
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (++n_lines > 1)
        throw error_at_line(line, "'" + words[0] + "' is a further line of " + keyword.title);
    });
    model.interactions.push_back({upper_case(keyword.option("NAME"))});
  }

  /// Contact is hard, whatever the stiffness of the deck.
  void read_behavior(const Keyword &keyword)
  {
    const auto law = upper_case(keyword.option("PRESSURE-OVERCLOSURE"));
    if (law == "HARD" && keyword.options.size() == 1)
      require_no_lines(reading, keyword);
    if (law == "TIED")
      {
        if (model.interactions.empty())
          throw keyword_error(keyword, keyword.title + " must follow *SURFACE INTERACTION");
        model.interactions.back().is_tied = true;
        reading.remarks.replaced("an exact tie instead of " + title_of(keyword) + " TIED",
                                 keyword.line);
      }
    else if (!law.empty() && law != "HARD")
      reading.remarks.replaced("hard contact instead of " + title_of(keyword) + " " + law,
                               keyword.line);
  }

  void read_friction(const Keyword &keyword)
  {
    if (model.interactions.empty())
      throw keyword_error(keyword, keyword.title + " must follow *SURFACE INTERACTION");
    const auto numbers = reading.first_line(keyword);
    if (numbers.empty())
      throw keyword_error(keyword, keyword.title + " must have a coefficient");
    model.interactions.back().friction = numbers[0];
    if (numbers.size() > 1)
      reading.remarks.replaced("sticking without slip instead of the second number of " +
                                 title_of(keyword),
                               keyword.line);
  }

  /// Read a line "slave surface, master surface".
  void read_pair(const Keyword &keyword)
  {
    if (!keyword.has("INTERACTION"))
      throw keyword_error(keyword, keyword.title + " has no INTERACTION");
    const auto interaction = upper_case(keyword.option("INTERACTION"));
    require_interaction(keyword, interaction);
    const bool is_tied = keyword.has("TIED") || upper_case(keyword.option("TYPE")) == "TIED" ||
                         is_tied_by(interaction);
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 2)
        return reading.lacks(keyword, " of a surface with itself", line);
      if (read_rigid_pair(keyword, words, is_tied, line))
        return;
      add_contacts(keyword, words, {"", "", 0, 0, interaction, 0., line, {}, false, 0., is_tied});
    });
  }

  /// Read a line "slave surface, master surface" of a tie.
  void read_tie(const Keyword &keyword)
  {
    if (keyword.has("CYCLICSYMMETRY") || keyword.has("MULTISTAGE"))
      return; // These options are noted as lacking.
    double tolerance = 0.;
    if (keyword.has("POSITIONTOLERANCE"))
      tolerance = to_number(keyword.option("POSITIONTOLERANCE"), keyword.line);
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 2 || words[1].empty())
        throw error_at_line(line, keyword.title + " must have a slave and a master surface");
      if (read_rigid_pair(keyword, words, true, line))
        return;
      const auto   master = reading.bodies.faces_of(reading.surface(words[1], line));
      const double reach =
        tolerance > 0. ? tolerance
                       : tie_tolerance * mesh_file::mean_size(reading.deck.mesh.points, master);
      add_contacts(keyword, words, {"", "", 0, 0, "", 0., line, {}, false, reach, true});
    });
  }

  void read_clearance(const Keyword &keyword)
  {
    if (!keyword.has("VALUE") || !keyword.has("SLAVE") || !keyword.has("MASTER"))
      return reading.lacks(keyword, " without SLAVE, MASTER and VALUE");
    const auto   slave    = reading.surface(keyword.option("SLAVE"), keyword.line);
    const auto   master   = reading.surface(keyword.option("MASTER"), keyword.line);
    const double value    = to_number(keyword.option("VALUE"), keyword.line);
    bool         is_found = false;
    for (auto &contact : model.contacts)
      if (contact.slave == slave && contact.master == master)
        {
          is_found = true;
          set_gap(keyword, contact, gaps(contact, slave_size(contact) + 2. * std::abs(value)),
                  value);
        }
    if (!is_found)
      throw keyword_error(keyword, "there is no *CONTACT PAIR of these surfaces");
  }

  void begin_general(const Keyword &keyword)
  {
    general_line = keyword.line;
    interaction.clear();
  }

  /// Add the pairs of general contact, which the mesh has found.
  void read_inclusions(const Keyword &keyword)
  {
    if (general_line == 0)
      throw keyword_error(keyword, keyword.title + " must follow *CONTACT");
    for (const auto &pair : reading.deck.general_pairs)
      if (pair.begin == keyword.begin && reading.use(keyword, pair.first, keyword.line) &&
          reading.use(keyword, pair.second, keyword.line))
        {
          DeckModel::Contact contact{pair.first, pair.second, 0, 0, interaction, 0., keyword.line};
          contact            = with_bodies(contact, reading.bodies.bodies_of(pair.first).front(),
                                           reading.bodies.bodies_of(pair.second).front());
          contact.is_general = true;
          contact.reach      = pair.reach;
          model.contacts.push_back(contact);
          reading.remarks.replaced("the pair '" + pair.first + "' with gaps from " +
                                     to_text(pair.least_gap) + " for general contact",
                                   keyword.line);
        }
  }

  /// Read a line ", , interaction", which holds for all contacts.
  void read_assignment(const Keyword &keyword)
  {
    reading.text.for_each_line(keyword, [&](const Words &words, const unsigned long line) {
      if (words.size() < 3 || !words[0].empty() || !words[1].empty())
        return reading.lacks(keyword, " of single surfaces", line);
      require_interaction(keyword, words[2]);
      if (is_tied_by(upper_case(words[2])))
        return reading.lacks(keyword, " of an interaction that is TIED", line);
      for (auto &contact : model.contacts)
        if (contact.is_general)
          contact.interaction = upper_case(words[2]);
      interaction = upper_case(words[2]);
    });
  }

private:
  Reading      &reading;
  DeckModel    &model;
  std::string   interaction; ///< of general contact
  unsigned long general_line = 0;

  void require_interaction(const Keyword &keyword, const std::string &name) const
  {
    if (name.empty())
      return;
    for (const auto &known : model.interactions)
      if (known.name == upper_case(name))
        return;
    throw keyword_error(keyword, "there is no *SURFACE INTERACTION '" + name + "'");
  }

  bool is_tied_by(const std::string &interaction) const
  {
    return std::any_of(model.interactions.begin(), model.interactions.end(),
                       [&](const auto &of) { return of.is_tied && of.name == interaction; });
  }

  /// Add a contact of the surfaces @p words for each pair of their bodies.
  void add_contacts(const Keyword &keyword, const Words &words, DeckModel::Contact contact)
  {
    const auto line = contact.line;
    contact.slave   = reading.surface(words[0], line);
    contact.master  = reading.surface(words[1], line);
    if (!reading.use(keyword, contact.slave, line) || !reading.use(keyword, contact.master, line))
      return;
    const auto slaves  = reading.bodies.bodies_of(contact.slave);
    const auto masters = reading.bodies.bodies_of(contact.master);
    const bool is_one  = slaves.size() == 1 && masters.size() == 1;
    bool       is_used = false;
    for (const unsigned int s : slaves)
      for (const unsigned int m : masters)
        if (auto of_bodies = with_bodies(contact, s, m); s != m && (is_one || is_near(of_bodies)))
          {
            is_used = true;
            adjust(keyword, of_bodies);
            model.contacts.push_back(of_bodies);
          }
    if (!is_used)
      reading.lacks(keyword, " of a body with itself, or of bodies far from each other", line);
  }

  static DeckModel::Contact
  with_bodies(DeckModel::Contact contact, const unsigned int slave, const unsigned int master)
  {
    contact.slave_body  = slave;
    contact.master_body = master;
    return contact;
  }

  mesh_file::Faces faces(const unsigned int body, const std::string &set) const
  {
    mesh_file::Faces result;
    for (const unsigned int face : reading.bodies.faces_on(body, set))
      result.push_back(reading.bodies.all()[body].outer[face]);
    return result;
  }

  /// Return whether the sides of a contact between several bodies are a face from each other.
  bool is_near(const DeckModel::Contact &contact) const
  {
    return !gaps(contact, contact.reach > 0. ? contact.reach : slave_size(contact)).faces.empty();
  }

  double slave_size(const DeckModel::Contact &contact) const
  {
    return mesh_file::mean_size(reading.deck.mesh.points, faces(contact.slave_body, contact.slave));
  }

  mesh_file::FaceGaps gaps(const DeckModel::Contact &contact, const double reach) const
  {
    return mesh_file::face_gaps(reading.deck.mesh.points, faces(contact.slave_body, contact.slave),
                                faces(contact.master_body, contact.master), reach);
  }

  /// Read a pair of a surface and a rigid one. Return whether it is one.
  bool read_rigid_pair(const Keyword      &keyword,
                       const Words        &words,
                       const bool          is_tied,
                       const unsigned long line)
  {
    for (const auto &[rigid, other] : {std::make_pair(1, 0), std::make_pair(0, 1)})
      if (is_rigid_surface(reading, words[rigid]))
        {
          if (is_tied)
            {
              reading.lacks(keyword, " that ties a rigid body", line);
              return true;
            }
          const auto slave = reading.surface(words[other], line);
          if (!reading.use(keyword, slave, line))
            return true;
          const auto obstacle =
            obstacle_of(reading, words[rigid], reading.bodies.faces_of(slave), line);
          if (!obstacle)
            return true;
          if (keyword.has("ADJUST"))
            reading.lacks(keyword, ": the option ADJUST with a rigid body", line);
          for (const unsigned int s : reading.bodies.bodies_of(slave))
            {
              DeckModel::Contact contact{
                slave, "", s, 0, upper_case(keyword.option("INTERACTION")), 0., line};
              contact.obstacle = obstacle;
              model.contacts.push_back(contact);
            }
          return true;
        }
    return false;
  }

  /// ADJUST moves the slave nodes within a distance onto the master. Nodes that are there already
  /// stay. The default of *TIE is YES.
  void adjust(const Keyword &keyword, DeckModel::Contact &contact)
  {
    const auto given = keyword.option("ADJUST");
    if (contact.is_tied)
      {
        if (upper_case(given) != "NO" && (keyword.name == "TIE" || !given.empty()))
          note_tied_gap(keyword, contact);
        return;
      }
    if (given.empty() || upper_case(given) == "NO" || upper_case(given) == "YES")
      return;
    const bool is_number = given.find_first_not_of("0123456789.eE+-") == std::string::npos;
    if (!is_number)
      return reading.lacks(keyword, ": the option ADJUST with a set");
    const auto near = gaps(contact, to_number(given, keyword.line));
    if (!near.faces.empty())
      set_gap(keyword, contact, near, 0.);
  }

  /// Note a gap of a tie that the deck closes, because nodes are tied as they lie.
  void note_tied_gap(const Keyword &keyword, const DeckModel::Contact &contact)
  {
    const auto   near    = gaps(contact, contact.reach > 0. ? contact.reach : slave_size(contact));
    const double largest = std::max(std::abs(near.least), std::abs(near.largest));
    if (!near.faces.empty() && largest > closed_gap * slave_size(contact))
      reading.remarks.replaced("a tie across gaps up to " + to_text(largest) +
                                 " instead of nodes moved onto the master side by " +
                                 title_of(keyword),
                               contact.line);
  }

  /// Let the gap of a contact be @p wanted, if that of the mesh is uniform.
  void set_gap(const Keyword             &keyword,
               DeckModel::Contact        &contact,
               const mesh_file::FaceGaps &mesh,
               const double               wanted)
  {
    if (contact.is_tied)
      return reading.remarks.not_needed(title_of(keyword) + " of a tie", keyword.line);
    const double rounding = closed_gap * slave_size(contact);
    if (!mesh.faces.empty() &&
        std::max(std::abs(mesh.least - wanted), std::abs(mesh.largest - wanted)) <= 1e-3 * rounding)
      return;
    if (mesh.faces.empty() || !mesh.is_whole || mesh.largest - mesh.least > rounding)
      return reading.lacks(keyword, " that changes gaps which are not uniform");
    contact.gap = wanted - 0.5 * (mesh.least + mesh.largest);
    reading.remarks.replaced("the gap " + to_text(wanted) + " instead of that of the mesh for " +
                               title_of(keyword),
                             keyword.line);
  }
};
} // namespace

KeywordReadings contact_readings(Reading &reading)
{
  const auto reader = std::make_shared<ContactReader>(reading);
  using M           = ContactReader;
  const auto by     = [reader](void (M::*read)(const Keyword &)) {
    return [reader, read](const Keyword &keyword) { (reader.get()->*read)(keyword); };
  };
  return {{"SURFACEINTERACTION", {by(&M::read_interaction), {{"NAME"}, {}}}},
          {"SURFACEBEHAVIOR",
           {by(&M::read_behavior),
            {{"PRESSURE-OVERCLOSURE"}, {"PENALTY", "AUGMENTEDLAGRANGE", "DIRECT", "LINEAR"}}}},
          {"FRICTION", {by(&M::read_friction), {{}, {"SLIPTOLERANCE", "ELASTICSLIP", "LAGRANGE"}}}},
          {"CONTACTPAIR",
           {by(&M::read_pair),
            {{"INTERACTION", "TYPE", "ADJUST", "TIED"},
             {"SMALLSLIDING", "NOTHICKNESS", "EXTENSIONZONE", "TRACKING", "MECHANICALCONSTRAINT",
              "WEIGHT", "CPSET", "SUPPLEMENTARYCONSTRAINTS", "OP", "HCRIT"}}}},
          {"TIE",
           {by(&M::read_tie),
            {{"NAME", "POSITIONTOLERANCE", "ADJUST"},
             {"TYPE", "NOROTATION", "NOTHICKNESS", "CONSTRAINTRATIO"}}}},
          {"CLEARANCE", {by(&M::read_clearance), {{"SLAVE", "MASTER", "VALUE", "CPSET"}, {}}}},
          {"CONTACT", {by(&M::begin_general), {{}, {"OP"}}, false}},
          {"CONTACTINCLUSIONS",
           {by(&M::read_inclusions), {{"ALLEXTERIOR", "ALLELEMENTBASED"}, {}}}},
          {"CONTACTPROPERTYASSIGNMENT", {by(&M::read_assignment)}}};
}
} // namespace snug::deck
