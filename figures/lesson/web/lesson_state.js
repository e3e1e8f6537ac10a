'use strict';
// What the reader has made so far: an isovalue, sites, and surface points inserted by hand. All else
// follows from these and is found anew when it is asked for.

const kLetters = 'ABCDEFGHJLMNPQRSUVWXYZ';

class State {
  constructor(header) {
    this.field = new Field(header);
    this.header = header;
    this.limit = 0.1;
    this.start_again();
  }

  start_again() {
    this.kappa = this.header.isovalue;
    this.contour = contour_of(this.field, this.kappa);
    this.sites = [];
    this.header.sites.forEach((place) => this.add_site(nearest_vertex(this.contour, place)));
    this.chosen = 0;
  }
  changed() {
    this.regions = regions_of(this.contour, this.sites);
    this.fault = certificate_of(this.contour, this.sites, this.regions);
    this.loops = this.fault ? null : dual_loops(this.contour, this.regions)
      .map((loop) => loop.map((n) => this.contour.points[this.sites[n]]));
    this.edge = null;  // a place on the edge that screen 5 is about; none: the worst
    this.by_hand = 0;
    this.said = '';
  }
  set_kappa(kappa) {
    const places = this.sites.map((v) => this.contour.points[v]);
    this.kappa = kappa;
    this.contour = contour_of(this.field, kappa);
    this.sites = [];
    for (const place of places) {
      const v = nearest_vertex(this.contour, place, (u) => !this.sites.includes(u));
      if (v >= 0) this.sites.push(v);
    }
    this.chosen = Math.min(this.chosen, this.sites.length - 1);
    this.changed();
  }
  add_site(v) {
    if (v < 0 || this.sites.includes(v)) return;
    this.sites.push(v);
    this.chosen = this.sites.length - 1;
    this.changed();
  }
  // At the vertex of T that is furthest from its site.
  add_furthest_site() {
    const far = this.regions.far;
    const v = far.indexOf(Math.max(...far));
    if (far[v] > 0) this.add_site(v);
  }
  move_site(n, v) {
    this.chosen = n;
    if (v < 0 || this.sites[n] === v) return;
    this.sites[n] = v;
    this.changed();
  }
  remove_site(n) {
    if (this.sites.length <= 1) return;
    this.sites.splice(n, 1);
    this.chosen = Math.min(n, this.sites.length - 1);
    this.changed();
  }
  certify() {
    this.sites = certify(this.contour, this.sites);
    this.changed();
  }

  name(n) {
    const round = Math.floor(n / kLetters.length);
    return kLetters[n % kLetters.length] + (round > 0 ? round : '');
  }
  note(n) {
    const arcs = this.regions.arcs[n], count = arcs.reduce((sum, arc) => sum + arc.vertices.length, 0);
    const pieces = arcs.length > 1 ? `, in ${arcs.length} pieces` : '';
    return `${counted(count, 'vertex', 'vertices')} of T${pieces}`;
  }

  facets() { return facets_of(this.field, this.kappa, this.loops); }
  // The facet that screen 5 is about.
  facet(facets) {
    const off = (f) => distance(f.center, this.edge);
    return facets.reduce((best, f) => (this.edge ? off(f) < off(best) : f.h > best.h) ? f : best);
  }
  insert() {
    const facets = this.facets(), facet = this.facet(facets);
    const why_not = insert_surface_point(this.field, this.kappa, this.loops, facets, facet);
    if (why_not === '') ++this.by_hand;
    this.edge = null;
    this.said = why_not === '' ? 'Inserted. Now another edge is the worst.' : `Refused: ${why_not}.`;
  }
  finished() {
    const loops = this.loops.map((loop) => [...loop]);
    return { loops, ...refine(this.field, this.kappa, loops, this.limit, 0.1) };
  }
}
