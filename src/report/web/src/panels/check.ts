// In: the report of a check of a model. Out: it as a person reads it, and what the marks in the picture mean.
import { at, entriesAt, numberAt, textsAt, type Json, type PageData } from '../data';
import { details, h, table } from '../dom';
import { count, figure, shown } from '../numbers';

export function marksLegend(data: PageData): HTMLElement {
    const entries = data.marks.map(mark => h('li', {}, h('i', { class: 'swatch', style: { background: `var(--mark-${mark.kind.replace(/[^a-z]/g, '')})` } }), mark.text));
    return h('section', {}, h('h2', {}, 'What is marked'),
        entries.length ? h('ul', { class: 'marks' }, ...entries) : h('p', { class: 'good' }, '✓ Nothing: the surface is closed, its parts face the same way, and no triangle is thin.'),
        h('p', { class: 'note' }, 'Thin lines are creases, where the surface turns by more than 30°.'));
}

function modelTable(model: Json): HTMLElement {
    const rows: [string, string][] = [
        ['triangles', count(at(model, 'triangles'))], ['vertices', count(at(model, 'vertices'))], ['size (mm)', shown(at(model, 'size_mm'))], ['closed', shown(at(model, 'closed'))],
        ['torn', shown(at(model, 'torn'))], ['volume (mm³)', figure(at(model, 'volume_mm3'))], ['area (mm²)', figure(at(model, 'area_mm2'))], ['shells', count(at(model, 'shell_count'))],
        ['borders', `${count(numberAt(model, 'borders', 'count'))}, ${figure(numberAt(model, 'borders', 'length_mm'))} mm in all`],
        ['non-manifold edges', count(numberAt(model, 'non_manifold_edges', 'count'))], ['non-manifold vertices', count(numberAt(model, 'non_manifold_vertices', 'count'))],
        ['turned triangles', count(at(model, 'turned_triangles'))], ['degenerate triangles', count(at(model, 'degenerate_triangles'))],
        ['duplicate triangles', count(numberAt(model, 'duplicate_triangles', 'count'))], ['slivers', count(numberAt(model, 'slivers', 'count'))],
        ['creases', `${count(numberAt(model, 'creases', 'count'))}, ${figure(numberAt(model, 'creases', 'length_mm'))} mm in all`],
        ['normals in the file', shown(at(model, 'normals', 'kind'))], ['self-intersections', at(model, 'self_intersections') === null ? 'not looked for' : count(numberAt(model, 'self_intersections', 'count'))]];
    return table(['', ''], rows);
}

export function checkPanel(report: Json): HTMLElement {
    const notes = textsAt(report, 'notes'), models = entriesAt(report, 'models');
    return h('div', {}, notes.length ? h('ul', {}, ...notes.map(note => h('li', {}, note))) : null,
        h('div', { class: 'cards' }, ...models.slice(0, 12).map(([name, model]) => h('article', { class: 'card' }, h('h3', {}, name), modelTable(model)))),
        models.length > 12 && details(`${models.length - 12} more`, table(['mesh', 'triangles', 'closed'], models.slice(12, 400).map(([name, m]) => [name, count(at(m, 'triangles')), shown(at(m, 'closed'))]))));
}
